# For tests that draw the report's charts (tests/support/draw_charts.hpp).
find_program(NODE node REQUIRED)

function(triptych_draws_charts test)
  set(script ${PROJECT_SOURCE_DIR}/tests/support/draw_charts.mjs)
  set(modules ${PROJECT_BINARY_DIR}/src/report/page/node_modules)
  target_include_directories(${test} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${test} PRIVATE
    TRIPTYCH_DRAW_CHARTS="'${NODE}' '${script}' '${modules}'")
endfunction()
