# corpus.awk -- docs/corpus.md from docs/corpus.csv; called by tools/corpus.   -v version= -v limit= -v refused=FILE
BEGIN { FS = ","; say["full"] = "as usual"; say["triangles"] = "triangles"; say["plain"] = "as drawn" }
NR == 1 { next }
{
    way = $1; name = $2
    if (!(name in seen)) { seen[name] = ++patterns; pattern[patterns] = name }
    line[way, name] = $0
    set = name
    sub(/\/[^\/]*$/, "", set)
    count("all", way)
    count(set == "foldability" ? "foldability" : "others", way)
}
# What is asked of a fold, the same for each set; NaN fails.
function count(set, way) {
    total[set, way]++
    folds = $19 == "folded" && $11 >= 99 && $12 <= 1e-8 && $13 <= 1e-8
    if (folds) folded[set, way]++
    if (folds && $23 == "free") free[set, way]++
    if (folds && $30 == "valid") judged[set, way]++
    if ($12 != "" && $12 <= 1e-8) closed[set, way]++
    if (set == "all" && way == "full" && folds && $16 >= 1e-9) { moved[++moves] = $16 + 0; stretched[moves] = $17 + 0 }
    if ($22 + 0 > slowest[set, way]) slowest[set, way] = $22 + 0
    percent[set, way] += $10
}
function of(n, all) { return sprintf("%d of %d", n, all) }
function short(x) { return x == "" ? "" : x == 0 ? "0" : sprintf("%.0e", x) }
# Degrees beyond half a turn, where they are more than may be.
function over(x) { return x > 0.1 ? sprintf("%.1f", x) : "" }
function part(x) { return x < 1e-9 ? "" : x < 0.0005 ? "< 0.001" : sprintf("%.3f", x) }
# Percent are cut, not rounded: 99.97 is not 100.
function cut(x) { return x == "" ? "" : sprintf("%.1f", int(x * 10) / 10) }
function summary(set, words,   w, way, i) {
    split("plain triangles full", w, " ")
    for (i = 1; i <= 3; i++) {
        way = w[i]
        if (!total[set, way]) continue
        printf "| %s | %s | %s | %d %% | %s | %s | %.1f %% | %s | %.1f |\n", words, say[way], of(folded[set, way], total[set, way]),
            100 * folded[set, way] / total[set, way], of(free[set, way], total[set, way]), way == "full" ? of(judged[set, way], total[set, way]) : "",
            percent[set, way] / total[set, way], of(closed[set, way], total[set, way]),
            slowest[set, way]
    }
}
function sort(a, n,   i, j, t) {
    for (i = 2; i <= n; i++)
        for (j = i; j > 1 && a[j] < a[j - 1]; j--) { t = a[j]; a[j] = a[j - 1]; a[j - 1] = t }
}
END {
    sort(pattern, patterns)
    sort(moved, moves)
    sort(stretched, moves)
    middle = int((moves + 1) / 2)
    print "# Which real crease patterns fold\n"
    print "Written by `make corpus`, by " version "; all columns and reasons are in [corpus.csv](corpus.csv). The patterns are other"
    print "people's and not part of this project. Each is flat-foldable at every vertex (angles to 0.6 degrees) and has one sheet without"
    print "holes; that does not mean that rigid facets can fold it.\n"
    print "**Folds** means: every driven crease within 1 % of its target, and in every frame closure (radians) and edge strain within"
    print "1e-8. **Free** means: it folds so, and no facets pass through each other, deeper than 1e-4 of the sheet; then it ends with 0."
    print "**Verified** means: it folds so, and `rigami verify` finds nothing against the written motion, in its frames or between them."
    print "**Closes** means closure within 1e-8 in every frame that was written, also of runs that stopped short. Seconds"
    print "are the processor's; after " limit " by the clock, with as many runs at once as there are cores, a run is ended and told as timeout.\n"
    print "| set | way | folds | | free | verified | mean folded | closes | slowest, s |\n|---|---|--:|--:|--:|--:|--:|--:|--:|"
    summary("foldability", "`foldability/`")
    summary("others", "other folders")
    summary("all", "all")
    print "\nAs drawn: `--adjust off --triangulate none --method newton`, the kinematics of section 2 alone. Triangles: `--triangulate all`"
    print "instead, section 3.2; both with `--contact report`. As usual: no options; added creases, adjusted creases of section 3.3 and what goes beyond it, each only"
    print "where the pattern needs it.\n"
    if (moves) {
        printf "%d of those that fold as usual do so with their vertices moved on the way: by %.1f %% of the sheet in the middle one,\n",
            moves, 100 * moved[middle]
        printf "by %.1f %% in the one that needs most; the paper itself is never stretched.\n\n", 100 * moved[moves]
    }
    print "## As usual\n"
    print "N: creases. Closed: closed vertices (3.1). Moved: the largest displacement of a vertex, over the sheet's size. Stretched: the"
    print "largest strain against the pattern given, over all frames. Over: degrees by which a crease was beyond half a turn, where they"
    print "are more than 0.1. Crosses from: percent folded where facets first pass through each other; pairs: how many do where they are"
    print "deepest; deep: how deep, over the sheet's size. Layers: whether the flat end has an order of layers without crossing. Verified: by\n\
`rigami verify`, from the written motion alone. Tries: of which this one is the first that folds, or the best.\n"
    print "| pattern | N | closed | outcome | folded, % | least, % | crosses from, % | pairs | deep | layers | verified | closure | strain | moved | stretched | over | tries | s | strategy |"
    print "|---|--:|--:|---|--:|--:|--:|--:|--:|---|---|--:|--:|--:|--:|--:|--:|--:|---|"
    for (i = 1; i <= patterns; i++) {
        split(line["full", pattern[i]], f, ",")
        crosses = f[23] == "crosses"
        printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s | %.1f | %s |\n", pattern[i], f[3], f[5],
            f[19], cut(f[10]), cut(f[11]), crosses ? cut(f[24]) : f[23], crosses ? f[26] : "", crosses ? short(f[27]) : "", f[29],
            f[30] == "" || f[30] == "valid" ? f[30] : "no", short(f[12]), short(f[13]), part(f[16]), part(f[17]), over(f[15]), f[8], f[22], f[7]
    }
    print "\n## As drawn, and in triangles\n"
    print "| pattern | as drawn: outcome | folded, % | least, % | closure | s | triangles: outcome | folded, % | least, % | closure | s |"
    print "|---|---|--:|--:|--:|--:|---|--:|--:|--:|--:|"
    for (i = 1; i <= patterns; i++) {
        printf "| %s", pattern[i]
        for (j = 1; j <= 2; j++) {
            split(line[j == 1 ? "plain" : "triangles", pattern[i]], f, ",")
            printf " | %s | %s | %s | %s | %.1f", f[19], cut(f[10]), cut(f[11]), short(f[12]), f[22]
        }
        print " |"
    }
    print "\n## Left out\n"
    print "| pattern | why |\n|---|---|"
    while ((getline row <refused) > 0) {
        at = index(row, ",")
        printf "| %s | %s |\n", substr(row, 1, at - 1), substr(row, at + 1)
    }
}
