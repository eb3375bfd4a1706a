/* select.h -- selectors of style sheets: which elements a rule is for.
 * Uses  xml.h        Used by  css.c
 *
 * Understood: tags, *, .class, #id, [name] with = ~= |= ^= $= *=, :not(), :is(), :where(), :root, :first-child,
 * :last-child, :only-child, :nth-child() and the like of types, joined by blank, >, + and ~. What depends on a pointer
 * or a link (:hover), and what is drawn besides an element (::before), is of no element here. */
#ifndef RG_SELECT_H
#define RG_SELECT_H

#include "read/xml.h"

/* How much a selector (no list) weighs against others; -1: not one that is understood. */
int32_t rg_select_weigh(const char *s, size_t n);
/* Whether it is one for that element. The selector is one that weighs. *work grows by the bytes that are looked at, an
 * element being worth some. */
int rg_select_matches(const char *s, size_t n, const rg_xml_node *node, int64_t *work);
/* Where the list of selectors s[0 ... n-1] has its first comma that stands in no bracket; n: nowhere. */
size_t rg_select_comma(const char *s, size_t n);

#endif
