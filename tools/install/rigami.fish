# Completion of rigami's commands, options and values for fish; `make install` puts it where fish looks for it.
# The program itself says which words there are.
function __rigami_words
    set -l line (commandline -opc) (commandline -ct)
    set -l program $line[1]
    set -l word $line[-1]
    if test (count $line) -eq 2; or test "$line[2]" = help
        $program help --words 2>/dev/null
        return
    end
    set -l before $line[-2]
    if string match -q -- '--*' $before
        set -l values ($program help --words $line[2] $before 2>/dev/null)
        if test (count $values) -gt 0
            printf '%s\n' $values
            return
        end
    end
    if string match -q -- '-*' $word
        $program help --words $line[2] 2>/dev/null
    else
        __fish_complete_path $word
    end
end
complete -c rigami -f -a '(__rigami_words)'
