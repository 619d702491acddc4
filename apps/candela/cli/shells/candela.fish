# Completion of candela in fish. The command itself prints the completions of a word, and fish quotes them.
function __candela_complete
    set -l words (commandline -opc)
    # The word without quotation marks and backslashes; the last quotation mark may be missing.
    set -l shown (commandline -ct)
    set -l typed
    for end in '' \' \"
        set typed (string unescape -- "$shown$end"); and break
    end
    set -q typed[1]; or set typed $shown
    for line in (CANDELA_COMPLETE=1 $words[1] $words[2..-1] "$typed" 2>/dev/null)
        switch $line
            case \tfiles \tfolders
                # After "--output=", a new word begins. The shell completes file names for any command, even ''.
                set -l option (string match -r -- '^--[^=]*=' "$typed")
                set -l path (string replace -r -- '^--[^=]*=' '' "$typed")
                set -l found (complete -C"'' "(string escape -- "$path"))
                test $line = \tfolders; and set found (string match -r -- '.*/$' $found)
                set -q found[1]; and printf '%s\n' "$option"$found
            case '*'
                printf '%s\n' $line
        end
    end
end
complete -c candela -f -a '(__candela_complete)'
