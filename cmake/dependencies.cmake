# Every part that is not ours. All of it is in Debian 12 and 13; ci/packages.txt lists the packages.
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(glm REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(SQLiteCpp REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(benchmark REQUIRED)
find_package(CLI11 REQUIRED)
# By Boost's own package file: CMake's FindBoost is gone from 3.30 on. Headers only.
find_package(Boost 1.74 REQUIRED CONFIG)
# Not by find_package: Debian's Imath package file asks for its Python binding as well.
pkg_check_modules(openexr REQUIRED IMPORTED_TARGET OpenEXR)
