# The manual's pages, made of what the program and the documents say: keyline(1), keyline-graph(5).
find_program(LOWDOWN lowdown DOC "Makes pages of the manual from Markdown")
if(NOT LOWDOWN)
  message(STATUS "lowdown is not there: no pages of the manual are made")
  return()
endif()

set(manual_folder ${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_DATAROOTDIR}/man)
set(manual_script ${CMAKE_CURRENT_LIST_DIR}/man_page.cmake)

# keyline_manual_page(PAGE SECTION ABOUT SOURCE): SOURCE is a file of Markdown.
function(keyline_manual_page page section about source)
  set(output ${manual_folder}/man${section}/${page}.${section})
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -D LOWDOWN=${LOWDOWN} -D SOURCE=${source} -D PAGE=${page} -D SECTION=${section}
            -D ABOUT=${about} -D VERSION=${PROJECT_VERSION} -D OUTPUT=${output} -P ${manual_script}
    DEPENDS ${source} ${manual_script} VERBATIM)
  add_custom_target(${page}.${section} ALL DEPENDS ${output})
  install(FILES ${output} DESTINATION ${CMAKE_INSTALL_MANDIR}/man${section})
endfunction()

# The commands, as the program declares them, and how they behave where nobody looks on.
set(commands ${PROJECT_BINARY_DIR}/manual/commands.md)
set(keyline_md ${PROJECT_BINARY_DIR}/manual/keyline.md)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/manual)
add_custom_command(OUTPUT ${keyline_md}
  COMMAND keyline_program help commands > ${commands}
  COMMAND ${CMAKE_COMMAND} -E cat ${commands} ${PROJECT_SOURCE_DIR}/docs/farm.md > ${keyline_md}
  DEPENDS keyline_program ${PROJECT_SOURCE_DIR}/docs/farm.md VERBATIM)

keyline_manual_page(keyline 1 "renders node graphs for toon looks" ${keyline_md})
keyline_manual_page(keyline-graph 5 "the language of Keyline's graph files" ${PROJECT_SOURCE_DIR}/docs/graphs.md)
