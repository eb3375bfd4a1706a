# manual.awk -- the options of a command as the manual page lists them, out of what the command itself says.
#     rigami help fold | awk -f manual.awk docs/rigami-fold.1 -
# The first file is the page, in which a line @options@ stands for them.
function text(s) { gsub(/\\/, "\\e", s); gsub(/-/, "\\-", s); return s ~ /^[.']/ ? "\\&" s : s }
function item(s,   n, word, i, out) {
    n = split(s, word, " ")
    out = ".It"
    for (i = 1; i <= n; i++) {
        if (word[i] ~ /^--/) out = out " Fl " text(substr(word[i], 2))
        else if (word[i] ~ /^-.,$/) out = out " Fl " substr(word[i], 2, 1) " ,"
        else out = out " Ar " text(word[i])
    }
    return out
}
FNR == 1 { part++ }
part == 1 { page[++lines] = $0; next }
/^$/ { ended = started; next }
ended { next }
/^  (-.,|   ) --/ {
    started = 1
    body = substr($0, 26)
    if (substr($0, 25, 1) == " " || length($0) < 26) head = substr($0, 1, 25)
    else { head = $0; body = "" }
    sub(/^ +/, "", head)
    options = options item(head) "\n"
    if (body != "") options = options text(body) "\n"
    next
}
started { s = $0; sub(/^ +/, "", s); options = options text(s) "\n" }
END {
    if (options == "") { print "manual.awk: no options" >"/dev/stderr"; exit 1 }
    for (i = 1; i <= lines; i++)
        if (page[i] == "@options@") printf "%s", options
        else print page[i]
}
