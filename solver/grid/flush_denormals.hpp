// Denormal numbers cost a hundred cycles each and arise wherever a correction decays over empty cells.
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace granvof {

// While it lives, results and operands too small to matter count as zero in this thread (or, given false, do
// not).
class FlushDenormals {
 public:
#if defined(__SSE2__)
  explicit FlushDenormals(bool flush = true) : previous_(_mm_getcsr()) {
    _mm_setcsr(flush ? previous_ | both : previous_ & ~both);
  }
  ~FlushDenormals() {
    _mm_setcsr(previous_);
  }
  // Whether this thread does so now.
  static bool on() {
    return (_mm_getcsr() & both) == both;
  }

 private:
  static constexpr unsigned both = 0x8040U;  // of results, of operands
  unsigned previous_;

 public:
#else
  explicit FlushDenormals(bool = true) {}
  ~FlushDenormals() {}
  static bool on() {
    return false;
  }
#endif
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals(FlushDenormals&&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;
  FlushDenormals& operator=(FlushDenormals&&) = delete;
};

}  // namespace granvof
