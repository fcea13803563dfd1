/// What tests leave out in a build with sanitizers. Those make programs five to twenty times as slow, and look for bad
/// memory and undefined arithmetic: a path that commits them does so in the first thousand samples or hardly ever, and a
/// third digit tells nothing of it. Values are held to what a commit without sanitizers asks of them; here it is enough
/// that every line runs and that nothing is grossly wrong.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TYNDALL_TESTS_SANITIZED true
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define TYNDALL_TESTS_SANITIZED true
#endif
#endif
#ifndef TYNDALL_TESTS_SANITIZED
#define TYNDALL_TESTS_SANITIZED false
#endif

namespace tyndall::test {

inline constexpr bool kSanitized = TYNDALL_TESTS_SANITIZED;

/// Factor of the errors that measure() and the checks of agreement.h ask for: 1 % becomes 5 %, from 1/25 of the samples. At a
/// tenth of the speed a test then takes less than half its usual time. Differences must stay within four of the errors
/// that are measured, here as everywhere.
inline constexpr double kCoarser = kSanitized ? 5 : 1;

/// Cases of a loop that tries `n` of a kind, or draws of a histogram.
template <typename Count>
constexpr Count fewer(Count n) {
  return kSanitized ? n / 10 : n;
}

}  // namespace tyndall::test
