# Makes a page of the manual from Markdown:
#   cmake -D LOWDOWN=… -D SOURCE=… -D PAGE=keyline-graph -D SECTION=5 -D ABOUT="…" -D VERSION=… -D OUTPUT=… -P man_page.cmake
string(TIMESTAMP today "%Y-%m-%d" UTC)  # that of $SOURCE_DATE_EPOCH where that is set
execute_process(
  COMMAND ${LOWDOWN} -s -Tman --out-no-smarty --nroff-nolinks -M title=${PAGE} -M section=${SECTION} -M date=${today} -M "source=Keyline ${VERSION}"
          -M volume=Keyline ${SOURCE}
  OUTPUT_VARIABLE page COMMAND_ERROR_IS_FATAL ANY)

# What people and `apropos` look for first.
string(REGEX REPLACE "(\n\\.TH [^\n]*\n)" "\\1.SH NAME\n${PAGE} \\\\- ${ABOUT}\n" page "${page}")
# A paragraph that follows a heading needs no mark.
string(REGEX REPLACE "(\n\\.S[HS]\n[^\n]*\n)\\.LP\n" "\\1" page "${page}")
# Constant width is no font of terminals, and bold is the habit of manuals.
string(REPLACE "\\fC" "\\fB" page "${page}")
# Tables as narrow as what is in them, without boxes: a first cell of one line is no block of text.
string(REPLACE "tab(|) expand allbox;" "tab(|);" page "${page}")
string(REGEX REPLACE "T{\n([^\n]*)\nT}\\|" "\\1|" page "${page}")
string(REGEX REPLACE "\nl l\\.\n" "\nl lx.\n" page "${page}")
cmake_path(GET OUTPUT PARENT_PATH folder)
file(MAKE_DIRECTORY ${folder})
file(WRITE ${OUTPUT} "${page}")
