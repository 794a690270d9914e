#include "planner/search/jump_search.hpp"

namespace ivo::planner {

void JumpSearch::start(const Graph& graph, int agent, Node from) noexcept {
  if (fresh_) {
    slot_.fill(kOutside);
    fresh_ = false;
  }
  for (int i = 0; i < touched_count_; ++i) {
    slot_[index(touched_[index(i)])] = kOutside;
  }
  graph_ = &graph;
  agent_ = agent;
  work_ = 0;
  touched_[0] = from;
  touched_count_ = 1;
  heap_size_ = 1;
  distance_m_[index(from)] = 0.0;
  edge_to_[index(from)] = -1;
  before_[index(from)] = -1;
  place(from, 0);
}

Node JumpSearch::settle_next() noexcept {
  if (heap_size_ == 0) {
    return -1;
  }
  const Node nearest = heap_[0];
  const Node last = heap_[index(--heap_size_)];
  slot_[index(nearest)] = kSettled;
  if (heap_size_ > 0) {
    place(last, 0);
    sink(last);
  }
  for (Edge e = graph_->first_edge(nearest); e < graph_->end_edge(nearest); ++e) {
    ++work_;
    const Node head = graph_->head(e);
    std::int32_t& slot = slot_[index(head)];
    if (!in(graph_->open_to(e), agent_) || slot == kSettled) {
      continue;
    }
    const double distance_m = distance_m_[index(nearest)] + graph_->length_m(e);
    if (slot == kOutside) {
      touched_[index(touched_count_++)] = head;
      place(head, heap_size_++);
    } else if (distance_m >= distance_m_[index(head)]) {
      continue;
    }
    distance_m_[index(head)] = distance_m;
    edge_to_[index(head)] = e;
    before_[index(head)] = nearest;
    rise(head);
  }
  return nearest;
}

void JumpSearch::place(Node n, std::int32_t slot) noexcept {
  heap_[index(slot)] = n;
  slot_[index(n)] = slot;
}

void JumpSearch::rise(Node n) noexcept {
  std::int32_t slot = slot_[index(n)];
  while (slot > 0) {
    const Node parent = heap_[index((slot - 1) / 2)];
    if (!nearer(n, parent)) {
      break;
    }
    place(parent, slot);
    slot = (slot - 1) / 2;
    place(n, slot);
  }
}

void JumpSearch::sink(Node n) noexcept {
  std::int32_t slot = slot_[index(n)];
  while (2 * slot + 1 < heap_size_) {
    std::int32_t child = 2 * slot + 1;
    if (child + 1 < heap_size_ && nearer(heap_[index(child + 1)], heap_[index(child)])) {
      ++child;
    }
    const Node c = heap_[index(child)];
    if (!nearer(c, n)) {
      break;
    }
    place(c, slot);
    slot = child;
    place(n, slot);
  }
}

}  // namespace ivo::planner
