/// What the compiler took for granted of the CPU.
#pragma once

#include <sys/platform/x86.h>

namespace tyndall::cli {

/// An extension of the instruction set, and its place among the C library's [glibc, sys/platform/x86.h].
struct CpuFeature {
  const char* name;
  unsigned int index;
};

/// Those that this build uses; ends with a name of null.
extern const CpuFeature kCpuNeeds[];

}  // namespace tyndall::cli
