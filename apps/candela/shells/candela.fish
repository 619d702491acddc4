# Completion of candela in fish; the command itself knows what a word may become.
function __candela_complete
    set -l words (commandline -opc) (commandline -ct)
    for line in (CANDELA_COMPLETE=1 $words[1] $words[2..-1] 2>/dev/null)
        switch $line
            case \tfiles
                __fish_complete_path (commandline -ct)
            case \tfolders
                __fish_complete_directories (commandline -ct)
            case '*'
                echo $line
        end
    end
end
complete -c candela -f -a '(__candela_complete)'
