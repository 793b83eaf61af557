# base_terrain.h reads content/base.
target_link_libraries(test_terrain PRIVATE vitrail_script)
