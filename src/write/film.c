#include "write/film.h"
#include "base/file.h"
#include "base/status.h"
#include "render/camera.h"
#include "render/frames.h"
#include "write/apng.h"
#include "write/gif.h"
#include "write/key.h"
#include "write/numbered.h"
#include "write/png.h"
#include "write/reel.h"
#include "write/video.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

/* To choose a GIF's colours, that many frames are looked at, drawn that much smaller. */
enum { LOOK_AT = 60, SMALLER = 4 };

typedef enum shape { NOTHING, FOLDER, NUMBERED, LAST, GIF, APNG, MP4, WEBM } shape;

static shape shape_of(const char *path)
{
    static const struct { const char *extension; shape shape; } shapes[] = {
        {".png", LAST}, {".gif", GIF}, {".apng", APNG}, {".mp4", MP4}, {".webm", WEBM}};
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
    struct stat is;
    rg_numbered n;
    if (slash && !*name) return FOLDER;
    for (size_t i = 0; dot && dot > name && i < sizeof shapes / sizeof *shapes; i++)
        if (strcasecmp(dot, shapes[i].extension) == 0)
            return shapes[i].shape == LAST && rg_numbered_find(path, &n) ? NUMBERED : shapes[i].shape;
    return stat(path, &is) == 0 && S_ISDIR(is.st_mode) ? FOLDER : NOTHING;
}

int rg_film_is_form(const char *path) { return shape_of(path) != NOTHING; }
int rg_film_is_animation(const char *path) { return shape_of(path) >= GIF; }

rg_status rg_film_check(const char *path, rg_diag *why)
{
    const shape is = shape_of(path);
    rg_numbered n;
    if (is == NOTHING) return rg_fail(RG_EARG, why, 0, "%.150s is no name of a picture", path);
    if (is == NUMBERED && rg_numbered_find(path, &n) > 1)
        return rg_fail(RG_EARG, why, 0, "%.150s: one number in a name is enough", path);
    if (is >= GIF && rg_numbered_find(path, &n) > 0)
        return rg_fail(RG_EARG, why, 0, "%.150s: one %s holds all frames: no number in its name", path,
                       strrchr(path, '.'));
    return is == MP4 || is == WEBM ? rg_video_check(why) : RG_OK;
}

/* Puts a file's name before what is wrong with it. */
static rg_status name_it(rg_status s, const char *path, rg_diag *why)
{
    if (s == RG_OK || !why || !path) return s;
    char text[sizeof why->text];
    memcpy(text, why->text, sizeof text);
    return rg_fail(s, why, 0, "%.150s: %s", path, text);
}

/* ---- pictures, each in its file */

static rg_status write_png(const rg_memory *mem, const rg_dest *to, const rg_picture *p, const unsigned char *rgb,
                           const char *run, rg_diag *why)
{
    rg_file file;
    rg_status s = rg_file_begin_to_swept(&file, mem, to, why);
    if (s != RG_OK) return s;
    s = rg_png_write(file.stream, p->width, p->height, rgb, run, why);
    if (s == RG_OK) return rg_file_commit(&file, why);
    rg_file_abandon(&file);
    return name_it(s, to->path, why);
}

typedef struct album {
    const rg_picture *picture;
    rg_numbered name;
    const rg_dest *to; /* NULL: one file a frame, by its number */
    char run[RG_KEY_ROOM];
    char *room;       /* for a name, of rg_numbered_room */
} album;

static rg_status paste(void *ctx, const rg_memory *mem, int32_t frame, const unsigned char *rgb, rg_diag *why)
{
    const album *a = ctx;
    if (a->to) return write_png(mem, a->to, a->picture, rgb, a->run, why);
    const size_t room = rg_numbered_room(&a->name);
    char *name = rg_mem_array(mem, room, 1);
    if (!name) return rg_fail(RG_ENOMEM, why, 0, "out of memory for a file name");
    rg_numbered_name(&a->name, frame, name, room);
    const rg_status s = write_png(mem, &(rg_dest){name, NULL}, a->picture, rgb, a->run, why);
    rg_mem_free(mem, name);
    return s;
}

/* Does it say so near its beginning? */
static int has_mark(const char *path, const char *mark, size_t length)
{
    char head[256];
    struct stat is;
    if (lstat(path, &is) != 0 || !S_ISREG(is.st_mode)) return 0;
    FILE *f = fopen(path, "rb");
    const size_t n = f ? fread(head, 1, sizeof head, f) : 0;
    if (f) fclose(f);
    for (size_t i = 0; i + length <= n; i++)
        if (memcmp(head + i, mark, length) == 0) return 1;
    return 0;
}

static int is_ours(const char *path)
{
    static const char mark[] = "tEXtSoftware\0" RG_PNG_SOFTWARE;
    return has_mark(path, mark, sizeof mark - 1);
}

/* A picture that was copied, or brought to the disk, in part is none. */
static int has_end(const char *path)
{
    static const unsigned char end[12] = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
    unsigned char last[sizeof end] = {0};
    FILE *f = fopen(path, "rb");
    const int whole = f && fseek(f, -(long)sizeof end, SEEK_END) == 0 && fread(last, sizeof end, 1, f) == 1;
    if (f) fclose(f);
    return whole && memcmp(last, end, sizeof end) == 0;
}

/* Is the frame there, of a run that drew the same? */
static int is_drawn(void *ctx, int32_t frame)
{
    const album *a = ctx;
    char mark[sizeof "tEXtRun" + RG_KEY_ROOM] = "tEXtRun";
    memcpy(mark + sizeof "tEXtRun", a->run, RG_KEY_ROOM - 1);
    rg_numbered_name(&a->name, frame, a->room, rg_numbered_room(&a->name));
    return has_mark(a->room, mark, sizeof "tEXtRun" + RG_KEY_ROOM - 1) && has_end(a->room);
}

/* Frames of a longer run before this one would be taken for its end. */
static rg_status remove_stale(const rg_motion *m, const rg_numbered *n, rg_diag *why)
{
    const size_t room = rg_numbered_room(n);
    char *name = rg_mem_array(&m->mem, room, 1);
    if (!name) return rg_fail(RG_ENOMEM, why, 0, "out of memory for a file name");
    rg_status s = RG_OK;
    for (int32_t frame = m->report.frame_count; s == RG_OK; frame++) {
        rg_numbered_name(n, frame, name, room);
        if (!is_ours(name)) break;
        if (unlink(name) != 0)
            s = rg_fail(RG_EWRITE, why, 0, "%.150s, of an earlier run, cannot be removed: %s", name, strerror(errno));
    }
    rg_mem_free(&m->mem, name);
    return s;
}

static rg_status write_numbered(const rg_motion *m, const char *path, rg_frames *f, rg_diag *why)
{
    album a = {.picture = &f->picture};
    rg_numbered_find(path, &a.name);
    f->take = paste;
    f->ctx = &a;
    rg_key_of(m, &f->picture, f->print, a.run);
    if (f->picture.resume) f->has = is_drawn;
    a.room = rg_mem_array(&m->mem, rg_numbered_room(&a.name), 1);
    rg_status s = a.room ? rg_frames_draw(m, f, why) : rg_fail(RG_ENOMEM, why, 0, "out of memory for a file name");
    rg_mem_free(&m->mem, a.room);
    return s == RG_OK ? remove_stale(m, &a.name, why) : s;
}

static rg_status write_one(const rg_motion *m, int32_t frame, const rg_dest *to, rg_frames *f, rg_diag *why)
{
    album a = {.picture = &f->picture, .to = to};
    f->first = frame;
    f->step = m->report.frame_count; /* and no other one */
    f->take = paste;
    f->ctx = &a;
    rg_key_of(m, &f->picture, f->print, a.run);
    return rg_frames_draw(m, f, why);
}

static rg_status write_folder(const rg_motion *m, const char *path, rg_frames *f, rg_diag *why)
{
    static const char name[] = "/%04d.png";
    const size_t n = strlen(path);
    struct stat is;
    char *pattern = rg_mem_array(&m->mem, n + sizeof name, 1);
    if (!pattern) return rg_fail(RG_ENOMEM, why, 0, "out of memory for a file name");
    memcpy(pattern, path, n);
    strcpy(pattern + n, path[n - 1] == '/' ? name + 1 : name);
    rg_status s = RG_OK;
    const int made = mkdir(path, 0777) == 0, reason = errno;
    if (!made && (stat(path, &is) != 0 || !S_ISDIR(is.st_mode)))
        s = rg_fail(RG_EWRITE, why, 0, "%.150s: cannot make this folder: %s", path,
                    strerror(reason == EEXIST ? ENOTDIR : reason));
    if (s == RG_OK) s = write_numbered(m, pattern, f, why);
    if (s != RG_OK && made) rmdir(path); /* stays if there is something in it */
    rg_mem_free(&m->mem, pattern);
    return s;
}

/* ---- animations, all frames in one file */

typedef struct sight {
    rg_palette *palette;
    size_t pixels;
} sight;

static rg_status see(void *ctx, const rg_memory *mem, int32_t frame, const unsigned char *rgb, rg_diag *why)
{
    const sight *at = ctx;
    (void)mem, (void)frame, (void)why;
    rg_palette_see(at->palette, rgb, at->pixels);
    return RG_OK;
}

static int32_t smaller(int32_t pixels) { return (pixels + SMALLER - 1) / SMALLER; }

/* The last frame and others before it, evenly spaced. */
static rg_status choose_colours(const rg_motion *m, const rg_frames *f, rg_palette *p, rg_diag *why)
{
    rg_frames look = *f;
    look.picture.width = smaller(f->picture.width);
    look.picture.height = smaller(f->picture.height);
    look.step = (m->report.frame_count + LOOK_AT - 1) / LOOK_AT;
    look.first = (m->report.frame_count - 1) % look.step;
    look.in_order = 1;
    look.take = see;
    look.picture.progress = NULL;
    sight at = {p, (size_t)look.picture.width * (size_t)look.picture.height};
    look.ctx = &at;
    rg_status s = rg_palette_init(p, &m->mem);
    if (s == RG_OK) s = rg_frames_draw(m, &look, why);
    else rg_fail(s, why, 0, "out of memory for the colours");
    if (s != RG_OK) return s;
    s = rg_palette_choose(p);
    return s == RG_OK ? s : rg_fail(s, why, 0, "out of memory for the colours");
}

/* The first and the last picture stay for a while; then, if it goes back, those between them come again from behind. */
typedef struct strip {
    rg_status (*add)(void *to, const unsigned char *rgb, double times, rg_diag *why);
    void *to;
    int32_t last;
    double first_times, last_times; /* how long they stay, in times of the others */
    int goes_back;
    rg_reel reel;
} strip;

/* At its beginning a film that goes round rests for half as long as at its end. */
static strip strip_of(const rg_motion *m, const rg_picture *p)
{
    const int32_t last = m->report.frame_count - 1;
    const double rest = p->hold * p->fps;
    return (strip){.last = last,
                   .first_times = last > 0 && p->loop != RG_LOOP_ONCE ? 1 + 0.5 * rest : 1,
                   .last_times = 1 + rest,
                   .goes_back = p->loop == RG_LOOP_BACK,
                   .reel = {.pixels = (size_t)p->width * (size_t)p->height}};
}

static int32_t pictures_of(const strip *f) { return f->last + 1 + (f->goes_back && f->last > 1 ? f->last - 1 : 0); }

static rg_status add_frame(void *ctx, const rg_memory *mem, int32_t frame, const unsigned char *rgb, rg_diag *why)
{
    strip *f = ctx;
    if (f->goes_back && frame > 0 && frame < f->last && rg_reel_keep(&f->reel, mem, rgb) != RG_OK)
        return rg_fail(RG_ENOMEM, why, 0, "out of memory for the way back");
    return f->add(f->to, rgb, frame == f->last ? f->last_times : frame == 0 ? f->first_times : 1, why);
}

static rg_status run_strip(const rg_motion *m, rg_frames *f, strip *film, rg_diag *why)
{
    f->take = add_frame;
    f->ctx = film;
    rg_status s = rg_frames_draw(m, f, why);
    unsigned char *rgb = rg_mem_array(&m->mem, film->reel.pixels, 3);
    if (s == RG_OK && !rgb) s = rg_fail(RG_ENOMEM, why, 0, "out of memory for the way back");
    for (int32_t i = film->reel.count - 1; s == RG_OK && i >= 0; i--) {
        rg_reel_show(&film->reel, i, rgb);
        s = film->add(film->to, rgb, 1, why);
    }
    rg_mem_free(&m->mem, rgb);
    rg_reel_free(&film->reel, &m->mem);
    return s;
}

static rg_status add_gif(void *to, const unsigned char *rgb, double times, rg_diag *why)
{
    return rg_gif_add(to, rgb, times, why);
}

static rg_status write_gif(const rg_motion *m, rg_file *file, rg_frames *f, rg_diag *why)
{
    const rg_picture *p = &f->picture;
    rg_palette palette;
    strip film = strip_of(m, p);
    rg_gif *gif = NULL;
    rg_status s = choose_colours(m, f, &palette, why);
    if (s == RG_OK)
        s = rg_gif_create(&m->mem, file->stream, p->width, p->height, p->fps, p->loop != RG_LOOP_ONCE, &palette, &gif,
                          why);
    film.add = add_gif;
    film.to = gif;
    if (s == RG_OK) s = run_strip(m, f, &film, why);
    if (s == RG_OK) s = rg_gif_finish(gif, why);
    rg_gif_destroy(gif);
    rg_palette_free(&palette);
    return s;
}

static rg_status add_apng(void *to, const unsigned char *rgb, double times, rg_diag *why)
{
    return rg_apng_add(to, rgb, times, why);
}

static rg_status write_apng(const rg_motion *m, rg_file *file, rg_frames *f, rg_diag *why)
{
    const rg_picture *p = &f->picture;
    strip film = strip_of(m, p);
    rg_apng *apng = NULL;
    rg_status s = rg_apng_create(&m->mem, file->stream, p->width, p->height, p->fps, pictures_of(&film),
                                 p->loop != RG_LOOP_ONCE, &apng, why);
    film.add = add_apng;
    film.to = apng;
    if (s == RG_OK) s = run_strip(m, f, &film, why);
    if (s == RG_OK) s = rg_apng_finish(apng, why);
    rg_apng_destroy(apng);
    return s;
}

/* A video has one pace: what stays is shown again. */
static rg_status add_video(void *to, const unsigned char *rgb, double times, rg_diag *why)
{
    rg_status s = RG_OK;
    for (double k = 0; s == RG_OK && k + 0.5 < times; k++) s = rg_video_add(to, rgb, why);
    return s;
}

/* The program writes into a file: on its way to a sink, into one that is gone afterwards. */
static rg_status run_video(const rg_motion *m, const char *path, const char *container, rg_frames *f, rg_diag *why)
{
    const rg_picture *p = &f->picture;
    strip film = strip_of(m, p);
    rg_video *video = NULL;
    rg_status s = rg_video_create(&m->mem, path, container, p->width, p->height, p->fps, p->background, &video, why);
    film.add = add_video;
    film.to = video;
    if (s == RG_OK) s = run_strip(m, f, &film, why);
    if (s == RG_OK) s = rg_video_finish(video, why);
    rg_video_destroy(video);
    return s;
}

static rg_status pass_on(int fd, FILE *out, rg_diag *why)
{
    char bytes[65536];
    ssize_t n;
    while ((n = read(fd, bytes, sizeof bytes)) > 0)
        if (fwrite(bytes, 1, (size_t)n, out) != (size_t)n) return rg_fail(RG_ENOMEM, why, 0, "out of memory");
    return n == 0 ? RG_OK : rg_fail(RG_EWRITE, why, 0, "%s", strerror(errno));
}

static rg_status write_video(const rg_motion *m, rg_file *file, const char *container, rg_frames *f, rg_diag *why)
{
    char reach[RG_FILE_REACH];
    if (!file->pile) return run_video(m, rg_file_reach(file, reach), container, f, why);
    const char *folder = getenv("TMPDIR");
    char path[1024];
    snprintf(path, sizeof path, "%.1000s/rigami-XXXXXX", folder && *folder ? folder : "/tmp");
    const int fd = mkstemp(path);
    if (fd < 0) return rg_fail(RG_EWRITE, why, 0, "%.150s: %s", path, strerror(errno));
    rg_status s = run_video(m, path, container, f, why);
    if (s == RG_OK) s = pass_on(fd, file->stream, why);
    close(fd);
    unlink(path);
    return s;
}

static rg_status write_animation(const rg_motion *m, shape is, const rg_dest *to, rg_frames *f, rg_diag *why)
{
    rg_file file;
    rg_status s = rg_file_begin_to(&file, &m->mem, to, why);
    if (s != RG_OK) return s;
    f->in_order = 1;
    s = is == GIF ? write_gif(m, &file, f, why) : is == APNG ? write_apng(m, &file, f, why)
      : write_video(m, &file, is == MP4 ? "mp4" : "webm", f, why);
    if (s == RG_OK) return rg_file_commit(&file, why);
    rg_file_abandon(&file);
    return name_it(s, to->path, why);
}

static rg_status write_any(const rg_motion *m, const char *path, int32_t frame, const rg_dest *to, const rg_picture *p,
                           int32_t threads, rg_diag *why)
{
    rg_status s = rg_film_check(path, why);
    if (s == RG_OK) s = rg_picture_check(p, why);
    if (s != RG_OK) return s;
    rg_print print = {NULL, 0, 0};
    unsigned char *rgba = NULL;
    if (p->image) s = name_it(rg_png_read(&m->mem, p->image, &print.width, &print.height, &rgba, why), p->image, why);
    if (s != RG_OK) return s;
    print.rgba = rgba;
    rg_frames f = {.picture = *p, .print = p->image ? &print : NULL, .step = 1, .threads = threads};
    const shape is = shape_of(path);
    switch (is) {
    case FOLDER: s = write_folder(m, path, &f, why); break;
    case NUMBERED: s = write_numbered(m, path, &f, why); break;
    case LAST: s = write_one(m, frame, to, &f, why); break;
    default: s = write_animation(m, is, to, &f, why); break;
    }
    rg_mem_free(&m->mem, rgba);
    return s;
}

rg_status rg_film_write_to(const rg_motion *m, const char *form, int32_t frame, const rg_dest *to, const rg_picture *p,
                           int32_t threads, rg_diag *why)
{
    const shape is = shape_of(form);
    if (is == FOLDER || is == NUMBERED)
        return rg_fail(RG_EARG, why, 0, "%.150s: many files, and there is one place for them", form);
    return write_any(m, form, frame, to, p, threads, why);
}

rg_status rg_film_write_by(const rg_motion *m, const char *path, const rg_picture *p, int32_t threads, rg_diag *why)
{
    return write_any(m, path, m->report.frame_count - 1, &(rg_dest){path, NULL}, p, threads, why);
}

rg_status rg_film_write(const rg_motion *m, const char *path, const rg_picture *p, rg_diag *why)
{
    return rg_film_write_by(m, path, p, 0, why);
}
