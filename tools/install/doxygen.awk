# doxygen.awk -- rigami.h with its comments as Doxygen wants them, line for line: those before a declaration and those behind one. What
# shares a comment in the header, members on one line or functions without a blank line between, has it each.
function behind(s,   at, code, comment, n, name, i, type, out) {
    at = index(s, "/*")
    code = substr(s, 1, at - 1)
    comment = substr(s, at)
    sub(/\/\*/, "/**<", comment)
    if (comment !~ /\*\//) { # ends on a line below: for the last of the names, and for the others as far as it goes
        rest = comment
        comment = comment " */"
    } else rest = ""
    n = code ~ /[(){}]/ ? 1 : split(code, name, /, */)
    if (n == 1) return s_with(s)
    type = name[1]
    sub(/[ *]*[A-Za-z_0-9\[\]]+ *$/, "", type)
    name[1] = substr(name[1], length(type) + 1)
    sub(/ *; *$/, "", name[n])
    for (i = 1; i <= n; i++) out = out type " " name[i] "; " (i == n && rest != "" ? rest : comment) " "
    return out
}
function s_with(s) { sub(/\/\*/, "/**<", s); return s }
{
    line = $0
    gsub(/<=/, "\\&le;", line)
    blank = line ~ /^ *$/
    if (inside) { # a comment that began above a declaration
        text = text " " line
        if (line ~ /\*\//) inside = 0
    } else if (NR == 1) {
        sub(/\/\* /, "/** @file\n * ", line)
        open = 1
    } else if (line ~ /^\/\* (---|===)/) {
    } else if (line ~ /^ *\/\*/) {
        sub(/\/\*/, "/**", line)
        text = line
        inside = line !~ /\*\//
        fresh = 1
    } else if (line ~ /[;,{})A-Za-z0-9] +\/\*/ && line !~ /^#/) line = behind(line)
    else if (line ~ /^RG_API void rg_[a-z]+_destroy\(/ && !fresh) line = "/** Frees it, and with it all that it lent; takes NULL. */ " line
    else if (line ~ /^(RG_API|#define) / && !fresh && text != "") {
        sub(/ \* /, " ", text)
        line = text " " line
    }
    if (blank) text = ""
    if (line ~ /^(RG_API|typedef|#define)/) fresh = 0
    print line
}
