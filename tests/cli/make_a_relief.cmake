# Makes a relief of a generated scan with the program RELIEVO in FOLDER. Fails if the solid is not a binary STL file
# whose length agrees with its number of triangles.
set(scan ${FOLDER}/whole_relief.ply)
set(body ${FOLDER}/whole_relief.stl)
execute_process(COMMAND ${RELIEVO} sample shell -o ${scan} --points 20000 COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${RELIEVO} make ${scan} -o ${body} --height 3 --preview ${FOLDER}/whole_relief.png --quiet
  COMMAND_ERROR_IS_FATAL ANY)

file(SIZE ${body} bytes)
file(READ ${body} count OFFSET 80 LIMIT 4 HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1" count ${count})
math(EXPR expected "84 + 50 * ${count}")
if(NOT bytes EQUAL expected OR count LESS 10000)
  message(FATAL_ERROR "${body}: expected ${expected} bytes and at least 10000 triangles, found ${bytes} bytes")
endif()
