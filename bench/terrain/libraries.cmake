# base_terrain.h reads content/base.
target_link_libraries(bench_terrain PUBLIC vitrail_script)
