#include "render/caption.h"

#include <string.h>

/* Letters of 5 x 7 dots, with one between them, from the space to the tilde: rows from the top, the leftmost dot the
 * highest of 5 bits. */
enum { WIDE = 5, HIGH = 7, FIRST = ' ', LAST = '~' };
static const unsigned char LETTER[LAST - FIRST + 1][HIGH] = {
    {0, 0, 0, 0, 0, 0, 0},        {4, 4, 4, 4, 4, 0, 4},        {10, 10, 0, 0, 0, 0, 0},
    {0, 10, 31, 10, 31, 10, 0},   {4, 15, 16, 14, 1, 30, 4},    {25, 25, 2, 4, 8, 19, 19},
    {12, 18, 12, 8, 21, 18, 13},  {4, 4, 0, 0, 0, 0, 0},        {2, 4, 8, 8, 8, 4, 2},
    {8, 4, 2, 2, 2, 4, 8},        {0, 21, 14, 31, 14, 21, 0},   {0, 4, 4, 31, 4, 4, 0},
    {0, 0, 0, 0, 4, 4, 8},        {0, 0, 0, 31, 0, 0, 0},       {0, 0, 0, 0, 0, 12, 12},
    {1, 1, 2, 4, 8, 16, 16},      {14, 17, 17, 21, 17, 17, 14}, {4, 12, 20, 4, 4, 4, 31},
    {14, 17, 1, 2, 4, 8, 31},     {14, 17, 1, 6, 1, 17, 14},    {2, 6, 10, 18, 31, 2, 2},
    {31, 16, 30, 1, 1, 17, 14},   {6, 8, 16, 30, 17, 17, 14},   {31, 1, 2, 2, 4, 4, 4},
    {14, 17, 17, 14, 17, 17, 14}, {14, 17, 17, 15, 1, 2, 12},   {0, 12, 12, 0, 12, 12, 0},
    {0, 12, 12, 0, 12, 4, 8},     {1, 2, 4, 8, 4, 2, 1},        {0, 0, 31, 0, 31, 0, 0},
    {16, 8, 4, 2, 4, 8, 16},      {14, 17, 1, 2, 4, 0, 4},      {14, 17, 23, 21, 23, 16, 14},
    {4, 10, 17, 17, 31, 17, 17},  {30, 17, 17, 30, 17, 17, 30}, {14, 17, 16, 16, 16, 17, 14},
    {28, 18, 17, 17, 17, 18, 28}, {31, 16, 16, 30, 16, 16, 31}, {31, 16, 16, 30, 16, 16, 16},
    {14, 17, 16, 23, 17, 17, 14}, {17, 17, 17, 31, 17, 17, 17}, {14, 4, 4, 4, 4, 4, 14},
    {7, 2, 2, 2, 2, 18, 12},      {17, 18, 20, 24, 20, 18, 17}, {16, 16, 16, 16, 16, 16, 31},
    {17, 27, 21, 21, 17, 17, 17}, {17, 25, 25, 21, 19, 19, 17}, {14, 17, 17, 17, 17, 17, 14},
    {30, 17, 17, 30, 16, 16, 16}, {14, 17, 17, 17, 21, 18, 13}, {30, 17, 17, 30, 20, 18, 17},
    {15, 16, 16, 14, 1, 1, 30},   {31, 4, 4, 4, 4, 4, 4},       {17, 17, 17, 17, 17, 17, 14},
    {17, 17, 17, 17, 10, 10, 4},  {17, 17, 17, 21, 21, 27, 17}, {17, 17, 10, 4, 10, 17, 17},
    {17, 17, 10, 4, 4, 4, 4},     {31, 1, 2, 4, 8, 16, 31},     {14, 8, 8, 8, 8, 8, 14},
    {16, 16, 8, 4, 2, 1, 1},      {14, 2, 2, 2, 2, 2, 14},      {4, 10, 17, 0, 0, 0, 0},
    {0, 0, 0, 0, 0, 0, 31},       {8, 4, 0, 0, 0, 0, 0},        {0, 0, 14, 1, 15, 17, 15},
    {16, 16, 30, 17, 17, 17, 30}, {0, 0, 14, 16, 16, 16, 14},   {1, 1, 15, 17, 17, 17, 15},
    {0, 0, 14, 17, 31, 16, 14},   {6, 8, 30, 8, 8, 8, 8},       {0, 0, 15, 17, 15, 1, 14},
    {16, 16, 30, 17, 17, 17, 17}, {4, 0, 12, 4, 4, 4, 14},      {2, 0, 6, 2, 2, 18, 12},
    {16, 16, 18, 20, 24, 20, 18}, {12, 4, 4, 4, 4, 4, 14},      {0, 0, 26, 21, 21, 21, 21},
    {0, 0, 30, 17, 17, 17, 17},   {0, 0, 14, 17, 17, 17, 14},   {0, 0, 30, 17, 30, 16, 16},
    {0, 0, 15, 17, 15, 1, 1},     {0, 0, 22, 24, 16, 16, 16},   {0, 0, 15, 16, 14, 1, 30},
    {8, 8, 30, 8, 8, 8, 6},       {0, 0, 17, 17, 17, 17, 15},   {0, 0, 17, 17, 10, 10, 4},
    {0, 0, 17, 21, 21, 21, 10},   {0, 0, 17, 10, 4, 10, 17},    {0, 0, 17, 17, 15, 1, 14},
    {0, 0, 31, 2, 4, 8, 31},      {6, 4, 4, 8, 4, 4, 6},        {4, 4, 4, 4, 4, 4, 4},
    {12, 4, 4, 2, 4, 4, 12},      {0, 0, 8, 21, 2, 0, 0}};

/* A dot is a pixel for each so many pixels of the shorter side, so that a picture made larger looks the same. */
enum { DOT = 300 };

static int32_t dot_of(int32_t width, int32_t height)
{
    const int32_t shorter = width < height ? width : height;
    return shorter / DOT > 1 ? shorter / DOT : 1;
}

int32_t rg_caption_height(int32_t width, int32_t height) { return (HIGH + 6) * dot_of(width, height); }

/* One letter for each code point of UTF-8. */
static int continues(char c) { return ((unsigned char)c & 0xc0) == 0x80; }

static int32_t letters_of(const char *text)
{
    int32_t n = 0;
    for (; *text; text++) n += !continues(*text);
    return n;
}

static void draw_letter(char c, int32_t x, int32_t y, int32_t dot, const unsigned char ink[3], int32_t width,
                        int32_t height, unsigned char *rgb)
{
    const unsigned char *rows = LETTER[(c >= FIRST && c <= LAST ? c : '?') - FIRST];
    for (int32_t i = 0; i < HIGH * dot; i++)
        for (int32_t j = 0; j < WIDE * dot; j++)
            if (rows[i / dot] >> (WIDE - 1 - j / dot) & 1 && x + j >= 0 && x + j < width && y + i >= 0 &&
                y + i < height)
                memcpy(rgb + 3 * ((size_t)(y + i) * (size_t)width + (size_t)(x + j)), ink, 3);
}

void rg_caption_draw(const char *left, const char *right, const unsigned char ink[3], int32_t width, int32_t height,
                     unsigned char *rgb)
{
    const int32_t dot = dot_of(width, height), step = (WIDE + 1) * dot, y = height - (HIGH + 3) * dot, edge = 3 * dot;
    int32_t room = (width - 2 * edge) / step, used = letters_of(right), x = width - edge - used * step + dot;
    for (; used <= room && *right; right++)
        if (!continues(*right)) draw_letter(*right, x, y, dot, ink, width, height, rgb), x += step;
    room -= used + 2;
    for (x = edge; room > 0 && *left; left++)
        if (!continues(*left)) draw_letter(*left, x, y, dot, ink, width, height, rgb), x += step, room--;
}

void rg_caption_ink(const unsigned char background[3], unsigned char ink[3])
{
    const int bright =
        (299 * background[0] + 587 * background[1] + 114 * background[2]) / 1000; /* luma, ITU-R BT.601 */
    memset(ink, bright < 128 ? 235 : 30, 3);
}
