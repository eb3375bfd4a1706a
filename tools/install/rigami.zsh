#compdef rigami
# Completion of rigami's commands, options and values for zsh; `make install` puts it where zsh looks for it, as _rigami.
# The program itself says which words there are.
_rigami() {
    local before=${words[CURRENT-1]} verb=${words[2]}
    local -a found
    if (( CURRENT == 2 )) || [[ $verb == help ]]; then
        found=(${(f)"$(${words[1]} help --words 2>/dev/null)"})
        compadd -- $found
        return
    fi
    if [[ $before == --* ]]; then
        found=(${(f)"$(${words[1]} help --words $verb $before 2>/dev/null)"})
        if (( $#found )); then
            compadd -- $found
            return
        fi
    fi
    if [[ ${words[CURRENT]} == -* ]]; then
        found=(${(f)"$(${words[1]} help --words $verb 2>/dev/null)"})
        compadd -- $found
    else
        _files
    fi
}
if [[ $zsh_eval_context[-1] == loadautofunc ]]; then _rigami "$@"; fi
