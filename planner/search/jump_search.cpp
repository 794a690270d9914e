#include "planner/search/jump_search.hpp"

namespace ivo::planner {

void JumpSearch::open(const Graph& graph) noexcept {
  graph_ = &graph;
  slot_.fill(kOutside);
  touched_count_ = 0;
  heap_size_ = 0;
  neighbourhood_of_.fill(kNone);
  for (Neighbourhood& neighbourhood : neighbourhoods_) {
    neighbourhood.owner = -1;
  }
  oldest_ = 0;
}

void JumpSearch::start(int agent, Node from) noexcept {
  agent_ = agent;
  from_ = from;
  work_ = 0;
  told_ = 0;
  searching_ = false;
  owner_ = index(agent) * limits::kNodes + index(from);
  if (neighbourhood_of_[owner_] != kNone) {
    return;
  }
  Neighbourhood& made = neighbourhoods_[oldest_];
  if (made.owner >= 0) {
    neighbourhood_of_[index(made.owner)] = kNone;
  }
  made.owner = static_cast<std::int32_t>(owner_);
  made.count = 0;
  made.whole = false;
  neighbourhood_of_[owner_] = static_cast<std::int16_t>(oldest_);
  oldest_ = (oldest_ + 1) % kNeighbourhoods;
}

Node JumpSearch::settle_next() noexcept {
  Neighbourhood& known = remembered();
  if (told_ < known.count) {
    const Settled& next = known.nodes[index(told_++)];
    edge_to_[index(next.node)] = next.edge;
    before_[index(next.node)] = next.before;
    distance_m_[index(next.node)] = next.distance_m;
    return next.node;
  }
  if (known.whole) {
    return -1;
  }
  if (!searching_) {
    begin_search();
  }
  const Node n = settle();
  if (n < 0) {
    known.whole = told_ == known.count;
    return -1;
  }
  if (++followed_ <= told_) {
    return kCatchingUp;
  }
  ++told_;
  if (known.count < kRemembered && known.count + 1 == told_) {
    known.nodes[index(known.count++)] = {n, before_[index(n)], edge_to_[index(n)], distance_m_[index(n)]};
  }
  return n;
}

void JumpSearch::begin_search() noexcept {
  for (int i = 0; i < touched_count_; ++i) {
    slot_[index(touched_[index(i)])] = kOutside;
  }
  work_ += touched_count_ / 8;
  searching_ = true;
  followed_ = 0;
  touched_[0] = from_;
  touched_count_ = 1;
  heap_size_ = 1;
  distance_m_[index(from_)] = 0.0;
  edge_to_[index(from_)] = -1;
  before_[index(from_)] = -1;
  place(from_, 0);
}

Node JumpSearch::settle() noexcept {
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
