# Completion of candela in bash. The command itself prints the completions of a word, quoted for where readline
# inserts them: in place of "$2".
_candela() {
    local shown
    COMPREPLY=()
    while IFS= read -r shown; do
        case $shown in
            $'\tfiles') compopt -o default ;;
            $'\tfolders') compopt -o dirnames ;;
            *)  # After a '=' or a '.', the word continues.
                [[ $shown == *[=.] ]] && compopt -o nospace
                COMPREPLY+=("$shown") ;;
        esac
    done < <(CANDELA_COMPLETE=bash "$1" "${COMP_LINE:0:COMP_POINT}" "$2" 2>/dev/null)
}
complete -F _candela candela
