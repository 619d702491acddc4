# Completion of candela in bash; the command itself knows what a word may become.
_candela() {
    local line=${COMP_LINE:0:COMP_POINT} word shown kept typed
    local -a words
    read -ra words <<<"$line"
    [[ $line == *[[:space:]] ]] && words+=('')
    typed=${words[-1]}
    # Readline takes a word to begin behind the last '=' or ':'.
    kept=${typed%"${typed##*[=:]}"}
    COMPREPLY=()
    while IFS= read -r shown; do
        case $shown in
            $'\tfiles') compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -- "${typed#"$kept"}"); return ;;
            $'\tfolders') compopt -o filenames; mapfile -t COMPREPLY < <(compgen -d -- "${typed#"$kept"}"); return ;;
        esac
        word=${shown%%$'\t'*}
        [[ $word == *[=.] ]] && compopt -o nospace
        COMPREPLY+=("${word#"$kept"}")
    done < <(CANDELA_COMPLETE=1 "${words[0]}" "${words[@]:1}" 2>/dev/null)
}
complete -F _candela candela
