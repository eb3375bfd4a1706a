# value.sh -- sourced by tools/corpus and tools/make_figures.
# A value of a report, or of what info says, which have one key on a line: value KEY FILE
value() { sed -n 's/^ *"'"$1"'": "\{0,1\}\(.*[^",]\)"\{0,1\},\{0,1\}$/\1/p' "$2" | head -n 1; }
