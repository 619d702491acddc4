# Completion of candela in bash; the command itself knows what a word may become, and how that is quoted where
# readline inserts it: in place of "$2".
_candela() {
    local shown
    COMPREPLY=()
    while IFS= read -r shown; do
        case $shown in
            $'\tfiles') compopt -o default ;;
            $'\tfolders') compopt -o dirnames ;;
            *)  # Behind a '=' or a '.', the word goes on.
                [[ $shown == *[=.] ]] && compopt -o nospace
                COMPREPLY+=("$shown") ;;
        esac
    done < <(CANDELA_COMPLETE=bash "$1" "${COMP_LINE:0:COMP_POINT}" "$2" 2>/dev/null)
}
complete -F _candela candela
