/* css.h -- as much of style sheets as drawings of creases need: properties of an element by its tag, class and name.
 * Uses  xml.h select.h lines.h        Used by  paint.h svg.c
 *
 * Rules with selectors of select.h, in @media all and screen too. What is not understood is passed over and told. */
#ifndef RG_CSS_H
#define RG_CSS_H

#include "lines/lines.h"
#include "read/xml.h"

typedef struct rg_rule {
    const char *selector, *body;
    size_t selector_n, body_n;
    int32_t weight;
    uint64_t names; /* a bit of each property that it says something of, by its name: most rules are told by it */
} rg_rule;

typedef struct rg_css {
    rg_memory mem;
    char **sheet; /* the texts that the rules point into */
    int32_t sheets;
    rg_rule *rule;
    int32_t rules;
    size_t room, sheet_room;
    int64_t work, most; /* bytes that were looked at, more or less, and may be */
} rg_css;

enum { RG_CSS_VALUE = 120, RG_CSS_MOST_RULES = 2000 };
/* Rules, selectors and elements multiply: so many bytes are looked at in half a second. */
enum { RG_CSS_MOST_WORK = 1 << 29 };

void rg_css_init(rg_css *css, const rg_memory *mem);
void rg_css_free(rg_css *css);
/* The rules of a <style> are taken in; l: for warnings. RG_EFORMAT: there are too many; RG_ENOMEM. */
rg_status rg_css_add(rg_css *css, const rg_xml_node *style, rg_lines *l, rg_diag *why);
/* What a property is for an element itself: by its `style`, by the rules, by its own attribute. 0: nothing is said.
 * A longer value than there is room for is cut. Where css->work is above css->most, not all rules were looked at: the
 * drawing is to be refused. */
int rg_css_get(rg_css *css, const rg_xml_node *n, const char *property, char value[RG_CSS_VALUE]);
/* The same without the attribute. */
int rg_css_said(rg_css *css, const rg_xml_node *n, const char *property, char value[RG_CSS_VALUE]);

#endif
