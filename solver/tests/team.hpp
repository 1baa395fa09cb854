// Several processes in one, for tests of what they do together: threads that meet wherever processes would
// exchange messages.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "solver/grid/communicator.hpp"

namespace granvof::test {

// Every process has a box of its own: they share sums and largest values, but no border.
class Team {
 public:
  explicit Team(int size) : parts_(static_cast<std::size_t>(size)) {}

  // work(number of the process, its communicator) in all of them at once. Throws what one of them threw: also
  // that they did not all do the same, or that one waited for another in vain.
  template <typename Work>
  void run(Work&& work) {
    std::vector<std::thread> threads;
    std::exception_ptr failure;
    for (std::size_t number = 0; number < parts_.size(); ++number)
      threads.emplace_back([&, number] {
        try {
          const Member member(*this, number);
          work(static_cast<int>(number), member);
          leave();
        } catch (...) {
          const std::lock_guard lock(mutex_);
          if (!failure) failure = std::current_exception();
          broken_ = true;
          met_.notify_all();
        }
      });
    for (std::thread& thread : threads) thread.join();
    if (failure) std::rethrow_exception(failure);
  }
  // Meetings so far.
  long meetings() const { return meetings_; }

 private:
  class Member final : public Communicator {
   public:
    Member(Team& team, std::size_t number) : team_(team), number_(number) {}
    void exchange(const Layout& layout, double* values) const override { join_ends(layout, values); }
    void exchange(const Layout& layout, float* values) const override { join_ends(layout, values); }
    void sum(std::span<double> values) const override {
      team_.meet("a sum", number_, values, [](double a, double b) { return a + b; });
    }
    void max(std::span<double> values) const override {
      team_.meet("a largest value", number_, values, [](double a, double b) { return std::max(a, b); });
    }

   private:
    Team& team_;
    std::size_t number_;
  };

  template <typename Combine>
  void meet(const std::string& what, std::size_t number, std::span<double> values, Combine&& combine) {
    std::unique_lock lock(mutex_);
    if (broken_) throw std::runtime_error("another process failed");
    if (waiting_ == 0) what_ = what;
    parts_[number].assign(values.begin(), values.end());
    if (what != what_ || (waiting_ > 0 && values.size() != size_))
      throw std::runtime_error("processes do different things: " + what + " beside " + what_);
    size_ = values.size();
    if (++waiting_ == parts_.size()) {
      result_ = parts_.front();  // in the order of the processes
      for (std::size_t p = 1; p < parts_.size(); ++p)
        for (std::size_t i = 0; i < size_; ++i) result_[i] = combine(result_[i], parts_[p][i]);
      waiting_ = 0;
      ++meetings_;
      met_.notify_all();
    } else {
      if (left_) throw std::runtime_error("a process waits for " + what + ", another is done");
      const long before = meetings_;
      if (!met_.wait_for(lock, longest_wait, [&] { return meetings_ != before || broken_; }))
        throw std::runtime_error("a process waited in vain for " + what);
      if (meetings_ == before) throw std::runtime_error("another process failed");
    }
    std::copy(result_.begin(), result_.end(), values.begin());
  }
  void leave() {
    const std::lock_guard lock(mutex_);
    if (waiting_ > 0) throw std::runtime_error("a process is done, another waits for " + what_);
    left_ = true;
  }

  static constexpr std::chrono::seconds longest_wait{60};
  std::mutex mutex_;
  std::condition_variable met_;
  std::vector<std::vector<double>> parts_;
  std::vector<double> result_;
  std::string what_;
  std::size_t waiting_ = 0, size_ = 0;
  long meetings_ = 0;
  bool broken_ = false, left_ = false;
};

// A process beside a twin that does just the same.
class Twin final : public Communicator {
 public:
  void exchange(const Layout& layout, double* values) const override { join_ends(layout, values); }
  void exchange(const Layout& layout, float* values) const override { join_ends(layout, values); }
  void sum(std::span<double> values) const override {
    for (double& v : values) v += v;
  }
  void max(std::span<double>) const override {}
};

}  // namespace granvof::test
