# Writes a build's identity, a part of fingerprints, as the C++ source OUTPUT. A script, because it runs when a source changes.
#   cmake -DROOT=... -DFOLDERS=a,b -DCOMPILER=... -DBUILD_TYPE=... -DFLAGS=... -DEIGEN=3.4.0 -DUNITY=1 -DOUTPUT=... -P write_build_identity.cmake
# Names are relative to ROOT, so the same sources have the same identity in any place, with git or without.
string(REPLACE "," ";" folders "${FOLDERS}")
set(sources)
foreach(folder ${folders})
  file(GLOB found RELATIVE ${ROOT} ${ROOT}/${folder}/*.h ${ROOT}/${folder}/*.cpp ${ROOT}/${folder}/*.cu
    ${ROOT}/${folder}/CMakeLists.txt)
  list(APPEND sources ${found})
endforeach()
if(NOT sources)
  message(FATAL_ERROR "no sources in ${FOLDERS} of ${ROOT}")
endif()
list(SORT sources)
# These flags contain the build's path and change no bit.
string(REGEX REPLACE "-f[a-z]+-prefix-map=[^ ]*" "" flags "${FLAGS}")
# Eigen is header-only; in a unity build sources are inlined into one another.
set(text "${flags}\nEigen ${EIGEN}\nunity ${UNITY}\n")
foreach(source ${sources})
  file(SHA256 ${ROOT}/${source} hash)
  string(APPEND text "${source} ${hash}\n")
endforeach()
string(SHA256 hash "${text}")
string(SUBSTRING ${hash} 0 16 hash)
file(WRITE ${OUTPUT} "#include \"model/engine/loading.h\"

namespace choreo {

const char* BuildIdentity() { return \"${COMPILER} ${BUILD_TYPE} ${hash}\"; }

}  // namespace choreo
")
