target_link_libraries(test_scene PRIVATE PkgConfig::ZLIB)
