# Completion of rigami's commands, options and values for bash; `make install` puts it where bash looks for it. By hand:
#     . tools/install/rigami.bash
# The program itself says which words there are.
_rigami() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb=${COMP_WORDS[1]} words
    if [ "$COMP_CWORD" = 1 ]; then
        words=$("${COMP_WORDS[0]}" help --words 2>/dev/null)
    elif [ "$verb" = help ]; then
        words=$("${COMP_WORDS[0]}" help --words 2>/dev/null)
    elif [ "${before#--}" != "$before" ] && words=$("${COMP_WORDS[0]}" help --words "$verb" "$before" 2>/dev/null) && [ -n "$words" ]; then
        :
    elif [ "${word#-}" != "$word" ]; then
        words=$("${COMP_WORDS[0]}" help --words "$verb" 2>/dev/null)
    else
        COMPREPLY=($(compgen -f -- "$word"))
        return
    fi
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}
complete -o filenames -o default -F _rigami rigami
