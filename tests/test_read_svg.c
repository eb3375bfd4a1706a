/* read/svg.c, css.c, colour.c: shapes, transforms, styles, colours, and what is refused. */
#include "read/colour.h"
#include "reading.h"

#include <pthread.h>

#define SVG(inside) "<svg xmlns=\"http://www.w3.org/2000/svg\">\n" inside "\n</svg>\n"

static rg_lines read_svg(const char *text) { return read_ok(text, RG_FORMAT_SVG, NULL); }

static void shapes(void **state)
{
    (void)state;
    rg_lines l = read_svg(SVG("<line stroke='red' x1='1' y1='2' x2='3.5' y2='-4'/>"
                              "<polyline stroke='#00f' points='0,0 10,0, 10 5.5'/>"
                              "<polygon stroke='black' points='0 0 1 0 1 1'/>"
                              "<rect stroke='#000' x='1' y='2' width='3' height='4'/>"));
    is_line(&l, 0, 'M', 1, -2, 3.5, 4, NAN);
    is_line(&l, 1, 'V', 0, 0, 10, 0, NAN);
    is_line(&l, 2, 'V', 10, 0, 10, -5.5, NAN);
    is_line(&l, 3, 'B', 0, 0, 1, 0, NAN);
    is_line(&l, 4, 'B', 1, 0, 1, -1, NAN);
    is_line(&l, 5, 'B', 1, -1, 0, 0, NAN);
    is_line(&l, 6, 'B', 1, -2, 4, -2, NAN);
    is_line(&l, 9, 'B', 1, -6, 1, -2, NAN);
    assert_int_equal(l.count, 10);
    assert_int_equal(l.line[0].where, 2);
    near(l.merge, 1e-3, 0);
    rg_lines_free(&l);
}

static void paths(void **state)
{
    (void)state;
    rg_lines l = read_svg(SVG("<path stroke='red' d='M1,2 l3-4 L-.5.5 H7v1V-3h-1z m10 10 1 1 2 0 M-1-1-2-2C-2.5-2.5-3-3-4-4Q-5,-5 -6,-6 a0 1 0 0 0 1 0'/>"));
    is_line(&l, 0, 'M', 1, -2, 4, 2, NAN);
    is_line(&l, 1, 'M', 4, 2, -.5, -.5, NAN);
    is_line(&l, 2, 'M', -.5, -.5, 7, -.5, NAN);
    is_line(&l, 3, 'M', 7, -.5, 7, -1.5, NAN);
    is_line(&l, 4, 'M', 7, -1.5, 7, 3, NAN);
    is_line(&l, 5, 'M', 7, 3, 6, 3, NAN);
    is_line(&l, 6, 'M', 6, 3, 1, -2, NAN);
    is_line(&l, 7, 'M', 11, -12, 12, -13, NAN); /* a relative m after z starts from where z led */
    is_line(&l, 8, 'M', 12, -13, 14, -13, NAN);
    is_line(&l, 9, 'M', -1, 1, -2, 2, NAN);
    is_line(&l, 10, 'M', -2, 2, -4, 4, NAN); /* curves that are straight are lines */
    is_line(&l, 11, 'M', -4, 4, -6, 6, NAN);
    is_line(&l, 12, 'M', -6, 6, -5, 6, NAN);
    assert_int_equal(l.count, 13);
    rg_lines_free(&l);
    /* Closing where the path is already adds no line of length 0. */
    l = read_svg(SVG("<path stroke='red' d='M0,0H1V1L0,0z'/>"));
    assert_int_equal(l.count, 3);
    rg_lines_free(&l);
}

static void transforms(void **state)
{
    (void)state;
    const struct { const char *transform; double x, y; } t[] = {/* of (3, 1), y down */
        {"translate(10)", 13, 1}, {"translate(10,-2.5)", 13, -1.5}, {"scale(2)", 6, 2}, {"scale(2 -1)", 6, -1},
        {"rotate(90)", -1, 3}, {"rotate(-90 1 1)", 1, -1}, {"rotate(30)", 3 * sqrt(0.75) - 0.5, 1.5 + sqrt(0.75)},
        {"skewX(45)", 4, 1}, {"skewY(45)", 3, 4}, {"matrix(1 2 3 4 5 6)", 11, 16}, {"translate(1,2) scale(3)", 10, 5},
        {"scale(3),translate(1 2)", 12, 9}, {" ", 3, 1}};
    for (size_t i = 0; i < sizeof t / sizeof *t; i++) {
        char text[300];
        snprintf(text, sizeof text, SVG("<line transform='%s' stroke='red' x1='3' y1='1'/>"), t[i].transform);
        rg_lines l = read_svg(text);
        near(l.line[0].a.x, t[i].x, 1e-13);
        near(l.line[0].a.y, -t[i].y, 1e-13);
        rg_lines_free(&l);
    }
    rg_lines l = read_svg(SVG("<g transform='translate(100 0)'><svg x='1cm' y='0'><g transform='scale(2)'>"
                              "<line transform='rotate(180)' stroke='blue' x1='3' y1='1'/></g></svg></g>"));
    is_line(&l, 0, 'V', 94 + 96 / 2.54, 2, 100 + 96 / 2.54, 0, NAN);
    rg_lines_free(&l);
}

/* What is repeated is where it would be, were it written out: transform, x and y, viewBox, style from without. */
static void repeats(void **state)
{
    (void)state;
    rg_lines l = read_svg("<svg xmlns:xlink='http://www.w3.org/1999/xlink' width='200' height='100'><defs>"
        "<line id='l' x1='1' y1='2' x2='3' y2='5'/><g id='pair' transform='translate(10 0)'>"
        "<use xlink:href='#l'/><use href='#l' x='1' y='.5' stroke='blue'/></g>"
        "<symbol id='s' viewBox='-1 -2 4 8' width='7' height='9'><path d='M1 2H3'/></symbol>"
        "<symbol id='plain'><path id='p' d='M1 2H3'/></symbol></defs>"
        "<use href='#l'/><use href='#pair' stroke='red' transform='scale(2)' x='100'/><use href='#later' opacity='.5'/>"
        "<g stroke='red'><use href='#s' x='5' y='6' width='4' height='8'/><use href='#s' width='8' height='32'/>"
        "<use href='#s' width='100%' height='8'/><use href='#plain' x='1' width='50'/><use href='#p' transform='rotate(90)' y='1'/></g>"
        "<path id='later' stroke='blue' d='M0 0V7'/><g stroke='black'>"
        "<svg x='10' y='20' width='8' height='8' viewBox='0 0 4 2' preserveAspectRatio='none'><path d='M1 1H3'/></svg>"
        "<svg x='10' y='20' width='8' height='8' viewBox='0 0 4 2' preserveAspectRatio='xMinYMax slice'><path d='M1 1H3'/></svg>"
        "<svg x='50' viewBox='0 0 100 100' preserveAspectRatio='xMaxYMid'><path d='M0 0H1'/></svg></g></svg>");
    const struct { char letter; double ax, ay, bx, by, target; } want[] = {
        {'M', 222, 4, 226, 10, NAN}, {'V', 224, 5, 228, 11, NAN}, {'V', 0, 0, 0, 7, 90}, {'M', 7, 10, 9, 10, NAN},
        {'M', 4, 16, 8, 16, NAN}, {'M', 100, 4, 102, 4, NAN}, {'M', 2, 2, 4, 2, NAN}, {'M', -3, 1, -3, 3, NAN},
        {'V', 0, 0, 0, 7, NAN}, {'B', 12, 24, 16, 24, NAN}, {'B', 14, 24, 22, 24, NAN}, {'B', 150, 0, 151, 0, NAN}};
    assert_int_equal(l.count, sizeof want / sizeof *want);
    assert_int_equal(l.warnings, 0);
    for (int32_t i = 0; i < l.count; i++)
        is_line(&l, i, want[i].letter, want[i].ax, -want[i].ay, want[i].bx, -want[i].by, want[i].target);
    rg_lines_free(&l);
    /* Of two elements with one id the first counts; what is nowhere is told. */
    l = read_svg(SVG("<g display='none'><path id='a' d='M0 0H1'/></g><path id='a' d='M0 0H2'/><use stroke='red' href='#a'/>\n"
                     "<use href='#b'/><use href='other.svg#a'/><use/>"));
    assert_int_equal(l.count, 1);
    is_line(&l, 0, 'M', 0, 0, 1, 0, NAN);
    assert_true(warned(&l, "no \"#b\"") && warned(&l, "\"other.svg#a\" lies in another file") && warned(&l, "hidden") && l.warnings == 4);
    assert_int_equal(l.warning[0].line, 3);
    rg_lines_free(&l);
}

/* Without end, or without end for all purposes. */
static void repeats_that_do_not_end(void **state)
{
    (void)state;
    refused(SVG("<g id='a'>\n<use href='#b'/></g><g id='b'>\n<use href='#a'/></g>"), RG_FORMAT_SVG, NULL, 3, "repeats itself");
    refused("<svg id='a'>\n<use href='#a'/></svg>", RG_FORMAT_SVG, NULL, 2, "repeats itself");
    refused("<svg>\n<use id='a' href='#a'/></svg>", RG_FORMAT_SVG, NULL, 2, "repeats itself");
    char text[20000];
    size_t n = (size_t)sprintf(text, "<svg><path id='g0' stroke='red' d='M0 0H1'/>");
    for (int i = 1; i <= 40; i++)
        n += (size_t)sprintf(text + n, "<g id='g%d'><use href='#g%d'/>\n<use href='#g%d'/></g>", i, i - 1, i - 1);
    sprintf(text + n, "</svg>");
    refused(text, RG_FORMAT_SVG, NULL, -1, "too large with all that it repeats");
    n = (size_t)sprintf(text, "<svg><path id='g0' stroke='red' d='M0 0H1'/>");
    for (int i = 1; i <= 400; i++) n += (size_t)sprintf(text + n, "<g id='g%d'><use href='#g%d'/></g>", i, i - 1);
    sprintf(text + n, "</svg>");
    refused(text, RG_FORMAT_SVG, NULL, 1, "nested too deep");
}

/* Nor does what says little by much: a line is not drawn a hundred thousand times with a style of a hundred thousand bytes, or by as many rules
 * as there may be. */
static void repeats_of_what_is_long(void **state)
{
    (void)state;
    enum { ROOM = 300000 };
    char *text = malloc(ROOM);
    assert_non_null(text);
    for (int rules = 0; rules < 2; rules++) {
        size_t n = (size_t)sprintf(text, "<svg><style>");
        for (int i = 0; rules && i < 2000; i++) n += (size_t)sprintf(text + n, "line.c%d{stroke:red} ", i);
        n += (size_t)sprintf(text + n, "</style><defs><g id='a0'><line x2='9' style='");
        for (int i = 0; !rules && i < 20000; i++) n += (size_t)sprintf(text + n, "fill:none;");
        n += (size_t)sprintf(text + n, "stroke:red'/></g>");
        for (int i = 0; i < 17; i++)
            n += (size_t)sprintf(text + n, "<g id='a%d'><use href='#a%d'/><use href='#a%d' y='%d'/></g>", i + 1, i, i, i);
        n += (size_t)sprintf(text + n, "</defs><use href='#a17'/></svg>");
        assert_true(n < ROOM);
        refused(text, RG_FORMAT_SVG, NULL, -1, rules ? "too much to look through" : " too ");
    }
    free(text);
}

/* What a style moves was read where it is drawn without. */
static void transforms_of_styles(void **state)
{
    (void)state;
    rg_lines l = read_svg(SVG("<style>.t{transform: translate(10px, 0px) rotate(90deg)} .n{transform:none}</style>"
                              "<g style='transform: translate(50px,0)'><line stroke='red' x2='1' y2='2'/></g>"
                              "<line class='t' stroke='red' x2='1' y2='2'/>"
                              "<line class='n' transform='translate(3)' stroke='red' x2='1' y2='2'/>"
                              "<line transform-origin='1 1' transform='rotate(180)' stroke='red' x2='1' y2='2'/>"
                              "<line style='transform-origin:1px 1px' transform='rotate(180deg)' stroke='red' x2='1' y2='2'/>"));
    assert_int_equal(l.count, 5);
    is_line(&l, 0, 'M', 50, 0, 51, -2, NAN);
    is_line(&l, 1, 'M', 10, 0, 8, -1, NAN);
    is_line(&l, 2, 'M', 0, 0, 1, -2, NAN);
    is_line(&l, 3, 'M', 2, -2, 1, 0, NAN);
    is_line(&l, 4, 'M', 2, -2, 1, 0, NAN);
    rg_lines_free(&l);
    refused(SVG("<line style='transform: rotate(1turn)' stroke='red' x2='1'/>"), RG_FORMAT_SVG, NULL, -1, "transform \"rotate(1turn)");
    refused(SVG("<line style='transform-origin:center' transform='scale(2)' stroke='red' x2='1'/>"), RG_FORMAT_SVG, NULL, -1, "transform-origin \"center");
}

/* A text of a head, a part so many times, a middle, another part so many times, and an end. The caller's. */
static char *repeated(const char *head, const char *one, int ones, const char *middle, const char *two, int twos, const char *end)
{
    const size_t room = strlen(head) + strlen(one) * (size_t)ones + strlen(middle) + strlen(two) * (size_t)twos + strlen(end) + 1;
    char *text = malloc(room), *at = text;
    assert_non_null(text);
    at = stpcpy(at, head);
    for (int i = 0; i < ones; i++) at = stpcpy(at, one);
    at = stpcpy(at, middle);
    for (int i = 0; i < twos; i++) at = stpcpy(at, two);
    stpcpy(at, end);
    return text;
}

/* Small files whose parts multiply: rules by elements, elements by those beside them, variables by what is around, stops of a
 * gradient, what is hidden, names. Each is refused or read; as they were, some of them took hours. */
static void what_multiplies_ends(void **state)
{
    (void)state;
    static const struct { const char *head, *one; int ones; const char *middle, *two; int twos; const char *end, *words; } tries[] = {
        {"<svg><style>", "q{stroke:red}", 2000, "</style>", "<line x2='1'/>", 20000, "</svg>", "too much to look through"},
        {"<svg><style>line:nth-child(2n){stroke:red}", " ", 0, "</style>", "<line x2='1'/>", 40000, "</svg>", "too much to look through"},
        {"<svg><style>", ".x{stroke:red}", 2000, "</style><g class='", "y ", 500000, "'/></svg>", "too much to look through"},
        {"<svg><style>", "q{--a:red}", 2000, "</style><g><g><g><g><g>", "<line x2='1' stroke='var(--a)'/>", 20000, "</g></g></g></g></g></svg>", "too much to look through"},
        {"<svg><linearGradient id='g'>", "<stop stop-color='red'/>", 20000, "</linearGradient>", "<path stroke='url(#g)' d='M0 0H1'/>", 20000, "</svg>",
         "too much to look through"},
        {"<svg><defs><g id='a' display='none'>", "<line/>", 20000, "</g></defs>", "<use href='#a'/>", 20000, "</svg>", "too large with all that it repeats"},
        {"<svg><style>", "%,", 1000000, "a{stroke:red}</style>", "<line stroke='red' x2='1'/>", 1, "</svg>", NULL},
        {"<svg><g id='", "long", 500000, "'>", "<path stroke='red' d='M0 0H1'/>", 20000, "</g></svg>", NULL}};
    for (size_t i = 0; i < sizeof tries / sizeof *tries; i++) {
        char *text = repeated(tries[i].head, tries[i].one, tries[i].ones, tries[i].middle, tries[i].two, tries[i].twos, tries[i].end);
        if (tries[i].words) {
            refused(text, RG_FORMAT_SVG, NULL, 1, tries[i].words);
        } else {
            rg_lines l = read_svg(text);
            assert_int_equal(l.count, tries[i].twos);
            rg_lines_free(&l);
        }
        free(text);
    }
}

/* Rules for the place among many, as drawing programs write them, are no such thing. */
static void places_among_many(void **state)
{
    (void)state;
    char *text = repeated("<svg><style>line:nth-child(2n){stroke:red}</style>", "<line x2='1'/>", 5000, "", "", 0, "</svg>");
    rg_lines l = read_svg(text);
    assert_int_equal(l.count, 2500);
    rg_lines_free(&l);
    free(text);
}

/* The parser tells a text that it finds too long as it does want of memory. */
static void a_text_too_long_is_no_want_of_memory(void **state)
{
    (void)state;
    char *text = repeated("<svg>\n<title>", "aaaaa&amp;\n", 1700000, "</title>", "", 0, "<line stroke='red' x2='1'/></svg>");
    refused(text, RG_FORMAT_SVG, NULL, -1, "a text of more than ten megabytes");
    free(text);
}

/* What one entity stands for, many times: the sum is bounded. */
static void entities_in_sum(void **state)
{
    (void)state;
    char *text = repeated("<!DOCTYPE svg [<!ENTITY a '", "x", 100000, "'>]>\n<svg>", "<g id='&a;'/>", 1000, "<line stroke='red' x2='1'/></svg>");
    refused(text, RG_FORMAT_SVG, NULL, 2, "entities open into more text");
    free(text);
}

static void styles(void **state)
{
    (void)state;
    rg_lines l = read_svg("<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd\">\n"
        SVG("<defs><style type='text/css'><![CDATA[ @import url(x.css); .m{stroke:#F00;fill:none} .v , .w { stroke : blue !important }"
            "/* a { } comment */ line{stroke:#000} #rim { stroke:black } line.half{stroke:red;opacity:.25} g .m{stroke:lime}"
            "@media print { .m { stroke: none } } .gone{display:none} ]]></style></defs>"
            "<line class='a m' x2='1'/><line class='v' x2='2'/><line x2='3'/><line id='rim' class='m' x2='4'/>"
            "<line class='m' style='stroke:blue' x2='5'/><line class='half' x2='6'/><line class='m gone' x2='7'/>"
            "<polyline stroke='red' class='w' points='0 0 8 0'/>"
            "<g stroke='blue'><path d='M0 0H9'/><path d='M0 0H10' stroke='inherit'/><path d='M0 0H11' stroke='none'/>"
            "<g opacity='.5'><path stroke-opacity='0.5' d='M0 0H12'/></g></g>"
            "<g style='display:none'><path stroke='red' d='M0 0H13'/></g>"
            "<g visibility='hidden'><path stroke='red' d='M0 0H14'/><path visibility='visible' stroke='red' d='M0 0H15'/></g>"
            "<path d='M0 0H16'/><path color='red' stroke='currentColor' d='M0 0H17'/><path stroke='rgba(0,0,255,.75)' d='M0 0H18'/>"
            "<symbol><path stroke='red' d='M0 0H19'/></symbol><clipPath><path stroke='red' d='M0 0H20'/></clipPath>"));
    const struct { char letter; double x, target; } want[] = {{'M', 1, NAN}, {'V', 2, NAN}, {'B', 3, NAN}, {'B', 4, NAN}, {'V', 5, NAN},
        {'M', 6, -45}, {'V', 8, NAN}, {'V', 9, NAN}, {'V', 10, NAN}, {'V', 12, 45}, {'M', 15, NAN}, {'M', 17, NAN}, {'V', 18, 135}};
    assert_int_equal(l.count, sizeof want / sizeof *want);
    for (int32_t i = 0; i < l.count; i++) is_line(&l, i, want[i].letter, 0, 0, want[i].x, 0, want[i].target);
    rg_lines_free(&l);
    rg_reading s = rg_reading_default();
    s.targets = 0;
    l = read_ok(SVG("<line stroke='red' opacity='.5' x2='1'/>"), RG_FORMAT_SVG, &s);
    is_line(&l, 0, 'M', 0, 0, 1, 0, NAN);
    rg_lines_free(&l);
}

static void colours(void **state)
{
    (void)state;
    const struct { const char *colour; char letter; } c[] = {{"#000", 'B'}, {"black", 'B'}, {"#231f20", 'B'}, {"#f00", 'M'}, {"RED", 'M'},
        {"#ed1c24", 'M'}, {"rgb(255, 0,0)", 'M'}, {"rgb(100%,0%,0%)", 'M'}, {"hsl(0,100%,50%)", 'M'}, {"#FF0000FF", 'M'}, {"darkred", 'M'},
        {"#00f", 'V'}, {"blue", 'V'}, {"hsl(240 100% 50%)", 'V'}, {"#2e3192", 'V'}, {"#0071bc", 'V'}, {"navy", 'V'},
        {"#ff0", 'F'}, {"yellow", 'F'}, {"gray", 'F'}, {"#cccccc", 'F'}, {"cyan", 'F'},
        {"#f0f", 'U'}, {"magenta", 'U'}, {"orange", 'U'}, {"#0f0", 'B'}, {"lime", 'B'}, {"green", 'B'}};
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        rg_colour rgb;
        double alpha;
        assert_true(rg_colour_parse(c[i].colour, &rgb, &alpha));
        near(alpha, 1, 0);
        if (rg_colour_assignment(rgb) != c[i].letter) print_error("%s\n", c[i].colour);
        assert_int_equal(rg_colour_assignment(rgb), c[i].letter);
    }
    const char *const none[] = {"", "#", "#ff", "#fffff", "#ggg", "rgb(", "rgb(1,2)", "rgb(1,2,3,4,5)", "rgb(a,b,c)", "reddish", "url(#x)", "12"};
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        rg_colour rgb;
        double alpha;
        assert_false(rg_colour_parse(none[i], &rgb, &alpha));
    }
    rg_colour c0;
    double alpha;
    assert_true(rg_colour_parse("#f008", &c0, &alpha));
    near(alpha, 136 / 255.0, 1e-15);
    rg_lines l = read_svg(SVG("<line stroke='url(#paint)' x2='1'/><line stroke='url(#paint)' x2='2'/>"));
    is_line(&l, 1, 'F', 0, 0, 2, 0, NAN);
    assert_int_equal(l.warnings, 1);
    rg_lines_free(&l);
}

/* Which rules are for an element: the letters of lines that are red if theirs is, else black. */
static void selectors(void **state)
{
    (void)state;
    const struct { const char *selector; int is; } c[] = {
        {".a line", 1}, {"svg .a line", 1}, {"svg > line", 0}, {".a > line", 1}, {"svg>.a>line", 1}, {"rect + line", 1}, {"path + line", 0},
        {"path ~ line", 1}, {"[id]", 1}, {"line[id=z]", 1}, {"line[id='y']", 0}, {"[class~=two]", 1}, {"[class~=tw]", 0}, {"[class^=on]", 1},
        {"[class$=two]", 1}, {"[class*='e t']", 1}, {"[lang|=en]", 1}, {":not(rect)", 1}, {"line:not(.one)", 0}, {"line:not([x2='1'], .b)", 1},
        {":is(line, rect)", 1}, {"line:last-child", 1}, {"line:first-child", 0}, {"line:nth-child(3)", 1}, {"line:nth-child(2n)", 0},
        {"line:nth-child(odd)", 1}, {"line:only-of-type", 1}, {"line:hover", 0}, {"line::before", 0}, {"g.a line.two#z", 1}, {"*", 1}, {".b line, #z", 1},
        {"@media screen { line", 1}, {"line:nth-child(+3)", 1}, {"line:nth-child(-2n+5)", 1}, {"line:nth-child(-n+2)", 0},
        {"line:not([x2=')'])", 1}, {"line:not(:is([x2='9'], rect))", 0}};
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        char text[700];
        snprintf(text, sizeof text, SVG("<style>line{stroke:black} %s{stroke:red !important}%s</style><g class='a'><path/><rect/>"
                                        "<line id='z' class='one two' lang='en-GB' x2='9'/></g>"), c[i].selector, c[i].selector[0] == '@' ? "}" : "");
        rg_lines l = read_svg(text);
        if (l.line[0].assignment != (c[i].is ? 'M' : 'B')) print_error("%s\n", c[i].selector);
        assert_int_equal(l.line[0].assignment, c[i].is ? 'M' : 'B');
        assert_int_equal(l.warnings, 0);
        rg_lines_free(&l);
    }
    /* What is not understood is told, with its text and its line. */
    rg_lines l = read_svg(SVG("<style>\n/* two\nlines */ line:has(a), #z {stroke: red}\n@import 'x.css';\n@media print{#z{stroke:blue}}\n"
                              ".a { line {stroke:blue} }\n@font-face{a:b}</style><line id='z' x2='9'/>"));
    assert_int_equal(l.line[0].assignment, 'M');
    assert_true(warned(&l, "\"line:has(a)\"") && warned(&l, "\"@import 'x.css'\"") && warned(&l, "\"@media print\"") && warned(&l, ".a { line"));
    assert_int_equal(l.warnings, 4);
    assert_int_equal(l.warning[0].line, 4);
    assert_int_equal(l.warning[1].line, 5);
    rg_lines_free(&l);
}

static void paints(void **state)
{
    (void)state;
    const struct { const char *paint; char letter; double target; } c[] = {
        {"#F00 icc-color(p, 1, 0)", 'M', NAN}, {"rgb(0 0 255 / 25%)", 'V', 45}, {"url(#gone) blue", 'V', NAN}, {"url( '#one' )", 'M', NAN},
        {"url(#link)", 'M', NAN}, {"var(--m)", 'M', NAN}, {"var(--gone, blue)", 'V', NAN}, {"var(--gone, var(--m))", 'M', NAN},
        {"currentColor", 'V', NAN}};
    for (size_t i = 0; i < sizeof c / sizeof *c; i++) {
        char text[700];
        snprintf(text, sizeof text, SVG("<defs><linearGradient id='one'><stop stop-color='red'/><stop stop-color='#f00'/></linearGradient>"
                                        "<linearGradient id='link' href='#one'/></defs><g style='--m: red' color='blue'><g stroke=\"%s\"><line x2='1'/></g></g>"),
                 c[i].paint);
        rg_lines l = read_svg(text);
        if (l.line[0].assignment != c[i].letter) print_error("%s\n", c[i].paint);
        is_line(&l, 0, c[i].letter, 0, 0, 1, 0, c[i].letter == 'V' ? c[i].target : NAN);
        assert_int_equal(l.warnings, 0);
        rg_lines_free(&l);
    }
    rg_lines l = read_svg(SVG("<line stroke='url(#x)' x2='1'/><line stroke='context-stroke' x2='2'/><path stroke='url(#x)' d='M0 0H1V1'/>"));
    assert_true(warned(&l, "\"url(#x)\" is no plain colour: taken for auxiliary lines (3)") && warned(&l, "\"context-stroke\" is no plain colour: taken for auxiliary lines (1)"));
    assert_int_equal(l.warnings, 2);
    rg_lines_free(&l);
}

/* What a drawing says of its lines besides their colour. */
static void names_dashes_data(void **state)
{
    (void)state;
    const char *text = SVG("<g stroke='black'><g id='Valley folds'><line x2='1'/></g><g xmlns:i='i' i:label='Mountain' id='g7'><line stroke='blue' x2='2'/>"
                           "<line x2='3'/></g><line class='rim' x2='4' stroke-dasharray='6,2 1,2'/></g><line data-assignment='m' data-foldAngle='-70' x2='5'/>");
    rg_lines l = read_svg(text);
    const char want[] = "VVMBM";
    for (int i = 0; i < 5; i++) assert_int_equal(l.line[i].assignment, want[i]);
    near(l.line[4].target / RG_DEG, -70, 1e-12);
    assert_int_equal(l.warnings, 0);
    rg_lines_free(&l);
    const char *const said[] = {"rim=unassigned", "Mountain=aux", "6 2 1 2=valley", "#00f=none"};
    rg_reading s = rg_reading_default();
    s.kind = said;
    s.kinds = 4;
    l = read_ok(text, RG_FORMAT_SVG, &s);
    assert_int_equal(l.count, 4);
    const char now[] = "VFVM";
    for (int i = 0; i < 4; i++) assert_int_equal(l.line[i].assignment, now[i]);
    rg_lines_free(&l);
}

static void sizes(void **state)
{
    (void)state;
    rg_lines l = read_svg("<svg viewBox='0 0 30 20' width='60mm' height='40mm'><rect stroke='black' x='10%' width='50%' height='100%'/></svg>");
    is_line(&l, 0, 'B', 3, 0, 18, 0, NAN);
    is_line(&l, 1, 'B', 18, 0, 18, -20, NAN);
    near(l.metres, 0.002, 1e-15);
    rg_lines_free(&l);
    l = read_svg("<svg viewBox='0 0 30 20'><path stroke='red' d='M0 0H9'/><path stroke='yellow' d='M0 0C1 1 2 1 3 0L9 9'/></svg>");
    near(l.metres, 0, 0);
    assert_int_equal(l.count, 2);
    is_line(&l, 1, 'F', 3, 0, 9, -9, NAN);
    assert_true(warned(&l, "curves of auxiliary lines are left out: 1"));
    rg_lines_free(&l);
}

static void refusals(void **state)
{
    (void)state;
    refused(SVG("\n<path stroke='red' d='M0 0C1 1 2 1 3 0'/>"), RG_FORMAT_SVG, NULL, 3, "C1 1 2 1 3 0");
    refused(SVG("<path stroke='red' d='M0 0q1 1 2 0'/>"), RG_FORMAT_SVG, NULL, 2, "curve");
    refused(SVG("<path stroke='red' d='M0 0A1 1 0 0 0 2 0'/>"), RG_FORMAT_SVG, NULL, 2, "curve");
    refused(SVG("<path stroke='red' d='M0 0L1 0S1 1 2 0'/>"), RG_FORMAT_SVG, NULL, 2, "curve");
    refused(SVG("<path stroke='red' d='L0 0'/>"), RG_FORMAT_SVG, NULL, 2, "begin with M");
    refused(SVG("<path stroke='red' d='M0 0L1'/>"), RG_FORMAT_SVG, NULL, 2, "missing");
    refused(SVG("<path stroke='red' d='M0 0L1 1x'/>"), RG_FORMAT_SVG, NULL, 2, "missing");
    refused(SVG("<path stroke='red' d='M0 0L1 1z1 1'/>"), RG_FORMAT_SVG, NULL, 2, "no command");
    refused(SVG("<rect stroke='red' width='1' height='1' rx='.1'/>"), RG_FORMAT_SVG, NULL, 2, "round");
    refused(SVG("<circle stroke='black' r='1'/>"), RG_FORMAT_SVG, NULL, 2, "curve");
    refused(SVG("<line stroke='red' x1='50%'/>"), RG_FORMAT_SVG, NULL, 2, "50%");
    refused(SVG("<line stroke='red' x1='much'/>"), RG_FORMAT_SVG, NULL, 2, "much");
    refused(SVG("<polygon stroke='red' points='1 2 3'/>"), RG_FORMAT_SVG, NULL, 2, "points");
    refused(SVG("<g transform='rotate(1 2)'><line stroke='red' x2='1'/></g>"), RG_FORMAT_SVG, NULL, 2, "rotate(1 2)");
    refused(SVG("<g transform='warp(1)'/>"), RG_FORMAT_SVG, NULL, 2, "warp");
    refused(SVG("<g transform='scale(1'/>"), RG_FORMAT_SVG, NULL, 2, "scale");
    refused(SVG("<line x2='1'/>"), RG_FORMAT_SVG, NULL, 2, "no shape has a stroke, 1 of them");
    refused(SVG("<g visibility='hidden'><line stroke='red' x2='1'/><path d='M0 0H1'/></g>"), RG_FORMAT_SVG, NULL, 2, "is hidden (display or visibility), 2 shapes");
    refused(SVG("<text>M</text>"), RG_FORMAT_SVG, NULL, 1, "no shapes");
    refused("<html><svg/></html>", RG_FORMAT_SVG, NULL, 1, "<html>");
    refused(SVG("<line stroke='red' x2='1'>"), RG_FORMAT_SVG, NULL, -1, "not well-formed");
    refused("<svg>", RG_FORMAT_SVG, NULL, -1, "not well-formed");
}

static void marks_and_numbers_too_large(void **state)
{
    (void)state;
    rg_lines l = read_svg(SVG("<circle stroke='red' r='1'/><circle stroke='red' r='1'/><circle r='2'/><use href='#x'/>"
                              "<path d='M0 0C1 1 2 1 3 0' fill='red'/><line stroke='red' x2='1e999'/><line stroke='red' x2='1e300' transform='scale(1e300)'/>"
                              "<line stroke='red' x2='1'/><title>later</title>"));
    assert_int_equal(l.count, 1);
    assert_true(warned(&l, "circles are left out as marks, no creases: 2") && warned(&l, "#x") && warned(&l, "finite"));
    assert_int_equal(l.warnings, 4);
    assert_string_equal(l.title, "later");
    rg_lines_free(&l);
}

static void texts(void **state)
{
    (void)state;
    rg_lines l = read_svg(SVG("<title>Kranich &amp; Co &#x6298;</title><desc>two\nlines</desc><metadata><rdf:RDF xmlns:rdf='r' xmlns:dc='d' xmlns:cc='c'>"
                              "<cc:Work><dc:creator><cc:Agent><dc:title>A. B.</dc:title></cc:Agent></dc:creator></cc:Work></rdf:RDF></metadata>"
                              "<line stroke='red' x2='1'/>"));
    assert_string_equal(l.title, "Kranich & Co \xE6\x8A\x98");
    assert_string_equal(l.memo, "two\nlines");
    assert_string_equal(l.author, "A. B.");
    rg_lines_free(&l);
}

/* Entities that would open into gigabytes are not opened. */
static void entities_stay_closed(void **state)
{
    (void)state;
    const char *text = "<!DOCTYPE svg [<!ENTITY a \"aaaaaaaaaaaaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\"><!ENTITY c \"&b;&b;&b;&b;&b;&b;&b;&b;\">"
        "<!ENTITY d \"&c;&c;&c;&c;&c;&c;&c;&c;\"><!ENTITY e \"&d;&d;&d;&d;&d;&d;&d;&d;\"><!ENTITY f \"&e;&e;&e;&e;&e;&e;&e;&e;\">"
        "<!ENTITY g \"&f;&f;&f;&f;&f;&f;&f;&f;\"><!ENTITY h \"&g;&g;&g;&g;&g;&g;&g;&g;\"><!ENTITY x SYSTEM \"file:///etc/passwd\">]>\n"
        "<svg><title>&h;&x;</title><line stroke='red' x2='1'/></svg>";
    rg_lines l;
    rg_diag why;
    if (read_text(text, strlen(text), RG_FORMAT_SVG, NULL, &l, &why) != RG_OK) return;
    assert_true(!l.title || strlen(l.title) < 1000);
    rg_lines_free(&l);
}

static void nesting_and_rules_end(void **state)
{
    (void)state;
    const size_t room = 1 << 20;
    char *text = malloc(room);
    assert_non_null(text);
    size_t n = (size_t)sprintf(text, "<svg>");
    for (int i = 0; i < 50000; i++) n += (size_t)sprintf(text + n, "<g>");
    refused(text, RG_FORMAT_SVG, NULL, 1, "not well-formed");
    n = (size_t)sprintf(text, "<svg><style>");
    for (int i = 0; i < 20000; i++) n += (size_t)sprintf(text + n, ".c%d{stroke:red}", i);
    sprintf(text + n, "</style><line class='c7' x2='1'/></svg>");
    refused(text, RG_FORMAT_SVG, NULL, 1, "rules of style");
    free(text);
}

static void *read_deep(void *text)
{
    refused(text, RG_FORMAT_SVG, NULL, -1, "nested too deep");
    return NULL;
}

/* Threads have half a megabyte of stack in some systems, and each level took two kilobytes. */
static void depth_fits_a_small_stack(void **state)
{
    (void)state;
    enum { LEVELS = 250, ROOM = 100 * LEVELS };
#ifdef __SANITIZE_ADDRESS__
    const size_t stack = (size_t)4 << 20;
#else
    const size_t stack = (size_t)1 << 19;
#endif
    char *text = malloc(ROOM);
    assert_non_null(text);
    size_t n = (size_t)sprintf(text, "<svg><defs>");
    for (int i = 0; i < LEVELS; i++) n += (size_t)sprintf(text + n, "<g id='a%d'><use href='#a%d'/></g>", i, i + 1);
    sprintf(text + n, "<line id='a%d' stroke='red' x2='1'/></defs><use href='#a0'/></svg>", LEVELS);
    pthread_attr_t small;
    pthread_t thread;
    assert_int_equal(pthread_attr_init(&small), 0);
    assert_int_equal(pthread_attr_setstacksize(&small, stack), 0);
    assert_int_equal(pthread_create(&thread, &small, read_deep, text), 0);
    assert_int_equal(pthread_join(thread, NULL), 0);
    pthread_attr_destroy(&small);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shapes), cmocka_unit_test(paths), cmocka_unit_test(transforms), cmocka_unit_test(transforms_of_styles), cmocka_unit_test(repeats), cmocka_unit_test(repeats_that_do_not_end), cmocka_unit_test(repeats_of_what_is_long),
        cmocka_unit_test(what_multiplies_ends), cmocka_unit_test(places_among_many), cmocka_unit_test(a_text_too_long_is_no_want_of_memory),
        cmocka_unit_test(entities_in_sum), cmocka_unit_test(styles),
        cmocka_unit_test(colours), cmocka_unit_test(selectors), cmocka_unit_test(paints), cmocka_unit_test(names_dashes_data), cmocka_unit_test(sizes),
                                       cmocka_unit_test(refusals), cmocka_unit_test(marks_and_numbers_too_large),
        cmocka_unit_test(texts), cmocka_unit_test(entities_stay_closed), cmocka_unit_test(nesting_and_rules_end), cmocka_unit_test(depth_fits_a_small_stack)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
