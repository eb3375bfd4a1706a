"""The C face as it is in the installed rigami.h, for cffi: every function and struct, none written down twice."""
import os
import re
import shlex
import subprocess
import tempfile

import cffi


def pkg_config(*options):
    tool = shlex.split(os.environ.get("PKG_CONFIG", "pkg-config"))
    try:
        said = subprocess.run([*tool, *options, "rigami"], check=True, capture_output=True, text=True)
        return shlex.split(said.stdout)
    except (OSError, subprocess.CalledProcessError):
        raise SystemExit("rigami is not installed where pkg-config looks: "
                         "`make install`, then PKG_CONFIG_PATH=PREFIX/lib/pkgconfig") from None


def header():
    folders = [word[2:] for word in pkg_config("--cflags-only-I")] + ["/usr/local/include", "/usr/include"]
    return next(path for folder in folders for path in [os.path.join(folder, "rigami.h")] if os.path.exists(path))


def declarations(path):
    """What the preprocessor makes of the header without those of the C library, in the words that cffi knows."""
    with tempfile.TemporaryDirectory() as empty:
        for name in ["stddef.h", "stdint.h", "math.h"]:
            open(os.path.join(empty, name), "w").close()
        compiler = shlex.split(os.environ.get("CC", "cc"))
        text = subprocess.run([*compiler, "-E", "-P", "-nostdinc", "-I", empty, path],
                              check=True, capture_output=True, text=True).stdout
    text = text.replace('__attribute__((visibility("default")))', "")
    text = re.sub(r"static inline ([^{;]*)\{[^}]*\}", r"\1;", text)
    constants = re.findall(r"^#define (RG_[A-Z_]+) +\(?\(?(?:double|-?[0-9.]+[.e])", open(path).read(), re.MULTILINE)
    return text + "".join(f"static const double {name};\n" for name in constants)


# What the library calls back, defined in rigami/__init__.py.
CALLED = """
extern "Python" int rigami_watch(void *, double);
extern "Python" int rigami_take(void *, const void *, size_t);
extern "Python" void rigami_warn(void *, const rg_diag *);
"""

builder = cffi.FFI()
builder.cdef(declarations(header()) + CALLED)
folders = [word[2:] for word in pkg_config("--libs-only-L")]
builder.set_source("rigami._face", "#include <rigami.h>", libraries=["rigami"], library_dirs=folders,
                   runtime_library_dirs=folders, include_dirs=[os.path.dirname(header())])
