# Run at build: the report's parts in FOLDER become string literals in OUTPUT. The order is the one below: what is
# constant at the top of a script must stand before who reads it as the page loads.
set(styles tokens page table graph pictures charts print)
set(scripts dom format data state theme tooltip sort_table verdict row_details results_table graph_view zoom picture
            compare picture_grid scale pass_bars pareto_points pareto trade_tables main)

function(read_parts suffix result)
  set(text "")
  file(GLOB found RELATIVE ${FOLDER} ${FOLDER}/*.${suffix})
  foreach(part IN LISTS ARGN)
    list(REMOVE_ITEM found ${part}.${suffix})
    file(READ ${FOLDER}/${part}.${suffix} content)
    string(APPEND text "${content}\n")
  endforeach()
  if(found)
    message(FATAL_ERROR "${FOLDER}: embed.cmake does not name ${found}")
  endif()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

file(READ ${FOLDER}/page.html page)
read_parts(css style ${styles})
read_parts(js script ${scripts})

file(WRITE ${OUTPUT} "#include \"framework/study/report_assets.hpp\"\n\nnamespace lightloom::study {\n\n")
foreach(asset IN ITEMS page style script)
  file(APPEND ${OUTPUT} "std::string_view report_${asset}() {\n  return R\"asset(" "${${asset}}" ")asset\";\n}\n\n")
endforeach()
file(APPEND ${OUTPUT} "}  // namespace lightloom::study\n")
