# Finds assimp, without what it links itself: libdraco has an old tinygltf in it, whose functions
# would stand in for the real ones wherever a program names it before libtinygltf.
find_package(assimp 5.2 REQUIRED)
set_property(TARGET assimp::assimp PROPERTY INTERFACE_LINK_LIBRARIES "")
