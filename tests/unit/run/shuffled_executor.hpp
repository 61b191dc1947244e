// SPDX-License-Identifier: MIT
// Processes that each make their own work, as those of a cluster do, and answer in any order.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "polhode/ensemble/executor.hpp"

namespace polhode::test {

class ShuffledExecutor : public ensemble::Executor {
 public:
  ShuffledExecutor(const ensemble::Ranks::MakeWork& make, int processes, unsigned seed)
      : random_(seed) {
    for (int k = 0; k < processes; ++k) all_.push_back(make());
  }
  int processes() const override { return static_cast<int>(all_.size()); }
  void run(ensemble::ExecutorWork&, const ensemble::ExecutorStage& stage, const Take& take,
           const std::function<void()>& look) override {
    for (const auto& process : all_) process->begin(stage.bytes);
    std::vector<std::int64_t> order;
    for (std::int64_t cell = stage.first; cell < stage.count; ++cell) order.push_back(cell);
    std::shuffle(order.begin(), order.end(), random_);
    std::map<std::int64_t, std::string> answers;
    for (const std::int64_t cell : order)
      answers[cell] = all_[random_() % all_.size()]->cell(cell, look);
    for (const auto& [cell, bytes] : answers) take(cell, bytes);
  }

 private:
  std::vector<std::unique_ptr<ensemble::ExecutorWork>> all_;
  std::mt19937 random_;
};

}  // namespace polhode::test
