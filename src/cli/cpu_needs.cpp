// Data alone, compiled as everything else is: the compiler tells by its macros what it uses.
#include "cli/cpu_needs.h"

namespace tyndall::cli {

constinit const CpuFeature kCpuNeeds[] = {
#ifdef __AVX__
    {"AVX", x86_cpu_AVX},
#endif
#ifdef __AVX2__
    {"AVX2", x86_cpu_AVX2},
#endif
#ifdef __FMA__
    {"FMA", x86_cpu_FMA},
#endif
#ifdef __BMI2__
    {"BMI2", x86_cpu_BMI2},
#endif
#ifdef __AVX512F__
    {"AVX-512 F", x86_cpu_AVX512F},
#endif
#ifdef __AVX512BW__
    {"AVX-512 BW", x86_cpu_AVX512BW},
#endif
#ifdef __AVX512VL__
    {"AVX-512 VL", x86_cpu_AVX512VL},
#endif
    {nullptr, 0},
};

}  // namespace tyndall::cli
