# Writes a build's identity, a part of fingerprints, as the C++ source OUTPUT. A script, because it runs when a source changes.
#   cmake -DROOT=... -DPARTS=a,b/one.cpp -DCOMPILER=... -DBUILD_TYPE=... -DFLAGS=... -DEIGEN=3.4.0 -DUNITY=1 -DOUTPUT=... -P write_build_identity.cmake
# Names are relative to ROOT, so the same sources have the same identity in any place, with git or without.
string(REPLACE "," ";" parts "${PARTS}")
set(sources)
foreach(part ${parts})
  if(IS_DIRECTORY ${ROOT}/${part})
    file(GLOB found RELATIVE ${ROOT} ${ROOT}/${part}/*.h ${ROOT}/${part}/*.cpp ${ROOT}/${part}/*.cu
      ${ROOT}/${part}/CMakeLists.txt)
  elseif(EXISTS ${ROOT}/${part})
    set(found ${part})
  else()
    message(FATAL_ERROR "there is no ${part} in ${ROOT}")
  endif()
  list(APPEND sources ${found})
endforeach()
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
