# Run at build: the parts of an HTML page become string literals in OUTPUT, as functions NAME_page, NAME_style and
# NAME_script of NAMESPACE that HEADER declares. page.html is FOLDER's; STYLES and SCRIPTS are names without suffix, by
# commas, found in FOLDER or else in SHARED. Their order matters: what is constant at the top of a script must stand
# before who reads it as the page loads.
function(read_parts suffix names result)
  set(text "")
  file(GLOB unnamed RELATIVE ${FOLDER} ${FOLDER}/*.${suffix})
  string(REPLACE "," ";" names "${names}")
  foreach(part IN LISTS names)
    list(REMOVE_ITEM unnamed ${part}.${suffix})
    if(EXISTS ${FOLDER}/${part}.${suffix})
      file(READ ${FOLDER}/${part}.${suffix} content)
    else()
      file(READ ${SHARED}/${part}.${suffix} content)
    endif()
    string(APPEND text "${content}\n")
  endforeach()
  if(unnamed)
    message(FATAL_ERROR "${FOLDER}: CMakeLists.txt does not name ${unnamed}")
  endif()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

file(READ ${FOLDER}/page.html page)
read_parts(css "${STYLES}" style)
read_parts(js "${SCRIPTS}" script)

file(WRITE ${OUTPUT} "#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n\n")
foreach(asset IN ITEMS page style script)
  file(APPEND ${OUTPUT} "std::string_view ${NAME}_${asset}() {\n  return R\"asset(" "${${asset}}" ")asset\";\n}\n\n")
endforeach()
file(APPEND ${OUTPUT} "}  // namespace ${NAMESPACE}\n")
