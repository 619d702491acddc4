# Bundles the modules of each page's script into one text, which the sources embed.
find_program(CANDELA_ESBUILD esbuild)
if(NOT CANDELA_ESBUILD)
    message(FATAL_ERROR "esbuild is missing, which bundles the scripts of pages; scripts/setup.sh installs it")
endif()
find_path(CANDELA_CODEMIRROR lib/codemirror.js PATHS /usr/share/javascript/codemirror /usr/share/nodejs/codemirror)
if(NOT CANDELA_CODEMIRROR)
    message(FATAL_ERROR "CodeMirror 5 is missing, the editor for formulas in pages; scripts/setup.sh installs it")
endif()
set(CANDELA_WEB ${CMAKE_CURRENT_LIST_DIR})
file(GLOB CANDELA_WEB_SCRIPTS CONFIGURE_DEPENDS ${CANDELA_WEB}/*.js ${CANDELA_WEB}/editor/*.js)

# candela_bundle_scripts(<output> <main.js> <scripts>...): the module and its imports, except the library three; not minified.
function(candela_bundle_scripts output main)
    cmake_path(GET main PARENT_PATH folder)
    cmake_path(GET main FILENAME name)
    add_custom_command(OUTPUT ${output}
        COMMAND ${CANDELA_ESBUILD} ${name} --bundle --external:three --format=esm --charset=utf8 --legal-comments=inline --log-level=warning
                --outfile=${output}
        WORKING_DIRECTORY ${folder} DEPENDS ${ARGN} COMMENT "Bundling a page's scripts" VERBATIM)
endfunction()

# candela_bundle_codemirror(<output>): the editor with its style, minified, as a script that defines CodeMirror.
function(candela_bundle_codemirror output)
    set(entry ${CANDELA_WEB}/editor/codemirror_bundle.js)
    add_custom_command(OUTPUT ${output}
        COMMAND ${CANDELA_ESBUILD} ${entry} --bundle --minify --format=iife --charset=utf8 --log-level=warning
                --alias:codemirror=${CANDELA_CODEMIRROR} --loader:.css=text
                "--banner:js=/* CodeMirror 5, copyright (c) by Marijn Haverbeke and others, MIT license */" --outfile=${output}
        DEPENDS ${entry} ${CANDELA_CODEMIRROR}/lib/codemirror.js COMMENT "Bundling CodeMirror" VERBATIM)
endfunction()
