/* The forms of output: which writer a path's shape and extension ask for, and that each file appears whole or not. */
#include "base/file.h"
#include "base/status.h"
#include "render/camera.h"
#include "write/csv.h"
#include "write/dxffile.h"
#include "write/film.h"
#include "write/foldfile.h"
#include "write/gltf.h"
#include "write/html.h"
#include "write/numbered.h"
#include "write/obj.h"
#include "write/paced.h"
#include "write/png.h"
#include "write/stl.h"
#include "write/svgfile.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

typedef struct form {
    const char *extension;
    int per_frame; /* one state: the last frame, or a file a frame for name-%04d */
    rg_status (*write)(const rg_motion *m, int32_t frame, const rg_picture *p, FILE *out);
} form;

static const form FORMS[] = {
    {".dxf", 0, rg_dxffile_write},
    {".csv", 0, rg_csv_write},      {".fold", 0, rg_foldfile_write},  {".glb", 0, rg_gltf_write_binary},
    {".gltf", 0, rg_gltf_write},    {".html", 0, rg_html_write},      {".obj", 1, rg_obj_write},
    {".stl", 1, rg_stl_write},      {".svg", 0, rg_svgfile_write},
};

static rg_status find_form(const char *path, const form **found, rg_diag *why)
{
    const char *name = strrchr(path, '/'), *dot;
    name = name ? name + 1 : path;
    dot = strrchr(name, '.');
    *found = NULL;
    for (size_t i = 0; dot && dot > name && i < sizeof FORMS / sizeof *FORMS; i++)
        if (strcasecmp(dot, FORMS[i].extension) == 0) *found = &FORMS[i];
    rg_numbered n;
    const int numbers = rg_numbered_find(path, &n);
    if (*found && numbers > (*found)->per_frame)
        return rg_fail(RG_EARG, why, 0, "%.100s: %s", path,
                       numbers > 1 ? "more than one place for a number in its name"
                                   : "one such file holds all frames: no number in its name");
    if (*found) return RG_OK;
    if (strcmp(path, "-") == 0)
        return rg_fail(RG_EARG, why, 0, "standard output has no extension that says what to write: name a file");
    return rg_fail(RG_EARG, why, 0, "%.80s: no such form of output; there are DIR/ NAME-%%04d.png .png .gif .apng .mp4 "
                   ".webm .obj .stl .glb .gltf .fold .csv .svg .dxf .html", path);
}

rg_status rg_output_check(const char *path, rg_diag *why)
{
    const form *f;
    return rg_film_is_form(path) ? rg_film_check(path, why) : find_form(path, &f, why);
}

void rg_output_sweep(const char *path, int mine)
{
    struct stat is;
    rg_numbered n;
    char start[PATH_MAX];
    const size_t length = strlen(path);
    const int is_folder = length > 0 && (path[length - 1] == '/' || (stat(path, &is) == 0 && S_ISDIR(is.st_mode)));
    const int numbered = !is_folder && rg_numbered_find(path, &n) == 1;
    const int wrote =
        snprintf(start, sizeof start, "%.*s%s", numbered ? n.before : (int)length, path, is_folder ? "/" : "");
    if (strcmp(path, "-") == 0 || wrote < 0 || wrote >= (int)sizeof start) return;
    rg_file_sweep(start, is_folder ? ".png" : numbered ? n.after : "", mine);
}

static rg_status cancelled(rg_diag *why) { return rg_fail(RG_ECANCELLED, why, 0, "%s", rg_status_text(RG_ECANCELLED)); }

/* Does who watches end it? */
static int ends(const rg_picture *p, double done) { return p->progress && p->progress(p->progress_ctx, done) != 0; }

static rg_status write_one(const rg_motion *m, const form *f, int32_t frame, const rg_picture *p, const rg_dest *to,
                           rg_diag *why)
{
    rg_file file;
    rg_status s = rg_file_begin_to_swept(&file, &m->mem, to, why);
    if (s != RG_OK) return s;
    s = f->write(m, frame, p, file.stream);
    if (s == RG_OK) return rg_file_commit(&file, why);
    rg_file_abandon(&file);
    return rg_fail(s, why, 0, "%.100s: %s", to->path ? to->path : f->extension, rg_status_text(s));
}

static rg_status write_each(const rg_motion *m, const form *f, const rg_numbered *n, const rg_picture *p, rg_diag *why)
{
    const size_t room = rg_numbered_room(n);
    char *name = rg_mem_array(&m->mem, room, 1);
    rg_status s = name ? RG_OK : rg_fail(RG_ENOMEM, why, 0, "%.100s: out of memory", n->path);
    for (int32_t k = 0; s == RG_OK && k < m->report.frame_count; k++) {
        rg_numbered_name(n, k, name, room);
        s = ends(p, (double)k / m->report.frame_count) ? cancelled(why)
                                                       : write_one(m, f, k, p, &(rg_dest){name, NULL}, why);
    }
    rg_mem_free(&m->mem, name);
    return s;
}

/* What is to be printed is looked at before anything is written, so that it is named where it is no picture. */
static rg_status check_image(const rg_motion *m, const char *path, rg_diag *why)
{
    unsigned char *bytes = NULL;
    size_t n = 0;
    rg_diag found = {0, ""};
    const rg_status s = rg_png_load(&m->mem, path, &bytes, &n, &found);
    rg_mem_free(&m->mem, bytes);
    return s == RG_OK ? s : rg_fail(s, why, 0, "%.100s: %s", path, found.text);
}

/* What is looked at as it moves; pictures each in its file are frames, as tables have them. */
static int is_film_or_page(const char *path)
{
    const char *dot = strrchr(path, '.');
    return rg_film_is_animation(path) || (dot && strcasecmp(dot, ".html") == 0);
}

static rg_status write_as_it_is(const rg_motion *m, const char *path, const rg_picture *p, rg_diag *why)
{
    const form *f;
    rg_numbered n;
    rg_status s = RG_OK;
    if (rg_film_is_form(path)) return rg_film_write(m, path, p, why);
    if (s == RG_OK) s = find_form(path, &f, why);
    if (s == RG_OK && p->image) s = check_image(m, p->image, why);
    if (s != RG_OK) return s;
    if (rg_numbered_find(path, &n)) return write_each(m, f, &n, p, why);
    if (ends(p, 0)) return cancelled(why);
    return write_one(m, f, m->report.frame_count - 1, p, &(rg_dest){path, NULL}, why);
}

rg_status rg_motion_write(const rg_motion *m, const char *path, const rg_picture *picture, rg_diag *why)
{
    rg_picture p;
    rg_motion paced;
    rg_output_sweep(path, 0);
    rg_status s = rg_picture_take(picture, &p, why); /* models and pages have its colours, view and pace, too */
    if (s != RG_OK || !p.steady || m->settings.pace == RG_PACE_STEADY || !is_film_or_page(path))
        return s == RG_OK ? write_as_it_is(m, path, &p, why) : s;
    s = rg_paced_init(&paced, m);
    s = s == RG_OK ? write_as_it_is(&paced, path, &p, why) : rg_fail(s, why, 0, "%.100s: %s", path, rg_status_text(s));
    rg_paced_free(&paced, m);
    return s;
}

rg_status rg_motion_write_to(const rg_motion *m, const char *extension, int32_t frame, const rg_sink *sink,
                             const rg_picture *picture, rg_diag *why)
{
    enum { ROOM = 16 };
    rg_picture mine, *const p = &mine;
    const rg_dest to = {NULL, sink};
    const form *f;
    char name[ROOM + 2] = "x";
    rg_status s = rg_picture_take(picture, p, why);
    if (s == RG_OK &&
        (extension[0] != '.' || strlen(extension) > ROOM || strchr(extension, '%') || strchr(extension, '/')))
        s = rg_fail(RG_EARG, why, 0, "%.80s: no extension such as .glb", extension);
    if (s == RG_OK && (frame < -1 || frame >= m->report.frame_count))
        s = rg_fail(RG_EARG, why, 0, "there is no frame %d", (int)frame);
    if (s != RG_OK) return s;
    if (frame < 0) frame = m->report.frame_count - 1;
    strcat(name, extension);
    if (rg_film_is_form(name)) return rg_film_write_to(m, name, frame, &to, p, 0, why);
    s = find_form(name, &f, why);
    if (s == RG_OK && p->image) s = check_image(m, p->image, why);
    if (s == RG_OK && ends(p, 0)) s = cancelled(why);
    return s == RG_OK ? write_one(m, f, frame, p, &to, why) : s;
}
