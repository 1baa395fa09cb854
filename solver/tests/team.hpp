// Several processes in one, for tests of what they do together: threads that meet wherever processes would
// exchange messages.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <functional>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "solver/grid/communicator.hpp"

namespace granvof::test {

// Whether one box is cut among the processes, or each has a box of its own, with shared sums but no border.
enum class Boxes { own, slabs };

class Team {
 public:
  explicit Team(int size, Boxes boxes = Boxes::own) : given_(static_cast<std::size_t>(size)), boxes_(boxes) {}

  // work(number of the process, its communicator) in all of them at once. Throws what one of them threw: also
  // that they did not all do the same, or that one waited for another in vain.
  template <typename Work>
  void run(Work&& work) {
    std::vector<std::thread> threads;
    std::exception_ptr failure;
    for (std::size_t number = 0; number < given_.size(); ++number)
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
  long meetings() const { return meetings_ / 2; }

 private:
  using Bytes = std::vector<std::byte>;

  class Member final : public Communicator {
   public:
    Member(Team& team, std::size_t number) : team_(team), number_(number) {}
    int size() const override {
      return team_.boxes_ == Boxes::own ? 1 : static_cast<int>(team_.given_.size());
    }
    int rank() const override { return team_.boxes_ == Boxes::own ? 0 : static_cast<int>(number_); }
    void sum(std::span<double> values) const override {
      combine("a sum", values, [](double a, double b) { return a + b; });
    }
    void max(std::span<double> values) const override {
      combine("a largest value", values, [](double a, double b) { return std::max(a, b); });
    }
    void trade(const End& below, const End& above) const override {
      Bytes mine(below.out.begin(), below.out.end());
      mine.insert(mine.end(), above.out.begin(), above.out.end());
      const std::size_t last = team_.given_.size() - 1;
      team_.meet("a trade", number_, std::move(mine), [&](const std::vector<Bytes>& all) {
        // Of the one below the end of what it gave, of the one above the beginning.
        const Bytes &lower = all[number_ == 0 ? last : number_ - 1],
                    &upper = all[number_ == last ? 0 : number_ + 1];
        if (lower.size() < below.in.size() || upper.size() < above.in.size())
          throw std::runtime_error("a neighbour gave less than was expected");
        std::copy_n(lower.end() - static_cast<std::ptrdiff_t>(below.in.size()), below.in.size(),
                    below.in.begin());
        std::copy_n(upper.begin(), above.in.size(), above.in.begin());
      });
    }
    void gather(std::span<const std::byte> mine, std::span<const std::size_t> sizes, std::span<std::byte> all,
                bool everywhere) const override {
      team_.meet("a gathering", number_, {mine.begin(), mine.end()}, [&](const std::vector<Bytes>& given) {
        if (!everywhere && number_ != 0) return;
        auto out = all.begin();
        for (std::size_t p = 0; p < given.size(); ++p) {
          if (given[p].size() != sizes[p]) throw std::runtime_error("a process gave what none expected");
          out = std::copy(given[p].begin(), given[p].end(), out);
        }
      });
    }
    void broadcast(std::span<std::byte> bytes) const override {
      team_.meet("a broadcast", number_, {bytes.begin(), bytes.end()}, [&](const std::vector<Bytes>& given) {
        std::copy_n(given.front().begin(), bytes.size(), bytes.begin());
      });
    }

   private:
    template <typename Combine>
    void combine(const std::string& what, std::span<double> values, Combine&& two) const {
      const auto mine = std::as_bytes(values);
      team_.meet(what, number_, {mine.begin(), mine.end()}, [&](const std::vector<Bytes>& all) {
        for (const Bytes& given : all) {  // in the order of the processes
          if (given.size() != mine.size())
            throw std::runtime_error("processes do different things in " + what);
          for (std::size_t i = 0; i < values.size(); ++i) {
            double value = 0.0;
            std::memcpy(&value, given.data() + i * sizeof value, sizeof value);
            values[i] = &given == &all.front() ? value : two(values[i], value);
          }
        }
      });
    }

    Team& team_;
    std::size_t number_;
  };

  // Everyone gives its bytes, and takes from all's once they are there; no one goes on before all have taken.
  void meet(const std::string& what, std::size_t number, Bytes mine,
            const std::function<void(const std::vector<Bytes>&)>& take) {
    {
      std::unique_lock lock(mutex_);
      if (broken_) throw std::runtime_error("another process failed");
      if (waiting_ == 0) what_ = what;
      if (what != what_)
        throw std::runtime_error("processes do different things: " + what + " beside " + what_);
      given_[number] = std::move(mine);
      wait_for_all(lock, what);
    }
    take(given_);
    std::unique_lock lock(mutex_);
    wait_for_all(lock, what);
  }
  void wait_for_all(std::unique_lock<std::mutex>& lock, const std::string& what) {
    if (++waiting_ == given_.size()) {
      waiting_ = 0;
      ++meetings_;
      met_.notify_all();
      return;
    }
    if (left_) throw std::runtime_error("a process waits for " + what + ", another is done");
    const long before = meetings_;
    if (!met_.wait_for(lock, longest_wait, [&] { return meetings_ != before || broken_; }))
      throw std::runtime_error("a process waited in vain for " + what);
    if (meetings_ == before) throw std::runtime_error("another process failed");
  }
  void leave() {
    const std::lock_guard lock(mutex_);
    if (waiting_ > 0) throw std::runtime_error("a process is done, another waits for " + what_);
    left_ = true;
  }

  static constexpr std::chrono::seconds longest_wait{60};
  std::mutex mutex_;
  std::condition_variable met_;
  std::vector<Bytes> given_;
  Boxes boxes_;
  std::string what_;
  std::size_t waiting_ = 0;
  long meetings_ = 0;  // times that all were there: twice for every meeting
  bool broken_ = false, left_ = false;
};

// A process beside a twin that does just the same.
class Twin final : public Communicator {
 public:
  void sum(std::span<double> values) const override {
    for (double& v : values) v += v;
  }
  void max(std::span<double>) const override {}
};

}  // namespace granvof::test
