# base_land.h reads content/base.
target_link_libraries(bench_pipeline PUBLIC vitrail_script)
