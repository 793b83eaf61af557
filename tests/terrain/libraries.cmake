# base_terrain.h reads content/base.
target_link_libraries(test_terrain PRIVATE vitrail_script)
# Lanes are vectors wider than the baseline passes in registers; they never cross files. Masks combine with & and |, which one lane has as bools.
target_compile_options(test_terrain PRIVATE -Wno-psabi -Wno-bitwise-instead-of-logical)
