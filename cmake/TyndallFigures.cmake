# `cmake --build build/release --target figures`: the paper's comparisons, as reports in <build folder>/figures.
set(TYNDALL_FIGURE_SECONDS 20 CACHE STRING "Render time of each variant and seed in the figures target")
if(TARGET tyndall_cli)
  add_custom_target(figures
    COMMAND sh ${PROJECT_SOURCE_DIR}/tests/figures/figures.sh $<TARGET_FILE:tyndall_cli> ${PROJECT_BINARY_DIR}/figures ${TYNDALL_FIGURE_SECONDS}
    USES_TERMINAL VERBATIM)
  add_dependencies(figures tyndall_cli)
endif()
