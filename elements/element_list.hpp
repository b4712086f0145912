#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "elements/element.hpp"

namespace arcwall {

/// Elements by their numbers, of which many that follow each other may be one object.
class ElementList {
 public:
  void add(std::shared_ptr<const Element> element, std::size_t times = 1) {
    if (objects_.empty() || objects_.back() != element) objects_.push_back(std::move(element));
    object_of_.insert(object_of_.end(), times, static_cast<std::uint32_t>(objects_.size() - 1));
  }

  std::size_t size() const { return object_of_.size(); }
  const Element& operator[](Index e) const { return *objects_[object_of_[static_cast<std::size_t>(e)]]; }

  void shrink_to_fit() {
    objects_.shrink_to_fit();
    object_of_.shrink_to_fit();
  }

 private:
  std::vector<std::shared_ptr<const Element>> objects_;
  std::vector<std::uint32_t> object_of_;
};

}  // namespace arcwall
