target_include_directories(bench_meshing PUBLIC ${CMAKE_SOURCE_DIR}/tests ${CMAKE_SOURCE_DIR}/bench/meshing)
