// Only so that the headers listed in CMakeLists.txt are compiled once for all tests.
