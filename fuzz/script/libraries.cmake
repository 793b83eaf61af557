# What content says of terrain is compiled too.
target_link_libraries(${name} PRIVATE vitrail_terrain)
