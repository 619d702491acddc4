# cmake -DCOMMAND=<candela> -DFOLDER=<folder> -P manual.cmake: writes a compressed manual page for each verb, and one for the command.
# Verbs with subverbs (plugin, exercise) have no page of their own, and neither do verbs whose program is not built yet.
function(write_page name)
    execute_process(COMMAND ${COMMAND} ${ARGN} --help-as man OUTPUT_VARIABLE page ERROR_QUIET RESULT_VARIABLE failed)
    if(failed OR page STREQUAL "")
        return()
    endif()
    file(WRITE ${FOLDER}/${name}.1 "${page}")
    file(ARCHIVE_CREATE OUTPUT ${FOLDER}/${name}.1.gz PATHS ${FOLDER}/${name}.1 FORMAT raw COMPRESSION GZip COMPRESSION_LEVEL 9)
    file(REMOVE ${FOLDER}/${name}.1)
endfunction()

# The names of the verbs that may follow, from the completions for a shell.
function(find_verbs result)
    execute_process(COMMAND ${CMAKE_COMMAND} -E env CANDELA_COMPLETE=1 ${COMMAND} ${ARGN} "" OUTPUT_VARIABLE lines
        COMMAND_ERROR_IS_FATAL ANY)
    string(REGEX MATCHALL "[a-z]+\t" names "${lines}")
    list(TRANSFORM names REPLACE "\t" "")
    set(${result} ${names} PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
find_verbs(verbs)
foreach(verb IN LISTS verbs)
    write_page(candela-${verb} ${verb})
    if(NOT EXISTS ${FOLDER}/candela-${verb}.1.gz)
        find_verbs(inner ${verb})
        foreach(each IN LISTS inner)
            write_page(candela-${verb}-${each} ${verb} ${each})
        endforeach()
    endif()
endforeach()
write_page(candela)
