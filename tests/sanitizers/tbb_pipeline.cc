// Tells ThreadSanitizer about the synchronization by a oneTBB pipeline, as tbb_tasks.cc does for tasks: a filter's
// work on an item happens after the work of the previous filter on it; a serial filter's work on an item happens
// after its work on the previous item; the first filter's work on an item, of which only so many are on their way,
// happens after the last filter's work on those that have left; and what follows the pipeline happens after all of it.
#include <oneapi/tbb/parallel_pipeline.h>
#include <sanitizer/tsan_interface.h>

#include <utility>

#include "tests/sanitizers/next_function.h"

namespace {

using albtpu::sanitizers::NextFunction;
using tbb::detail::d1::base_filter;
using tbb::detail::d1::filter_node;
using tbb::detail::d1::task_group_context;

unsigned int ModeOf(base_filter& filter) {
  unsigned int mode = filter.is_serial() ? base_filter::filter_is_serial : 0;
  if (filter.is_serial() && !filter.is_ordered()) mode |= base_filter::filter_is_out_of_order;
  if (filter.object_may_be_null()) mode |= base_filter::filter_may_emit_null;
  return mode;
}

struct Place {
  const filter_node* pipeline;
  bool first = true, last = true;
};

// Wraps a filter.
class WatchedFilter final : public base_filter {
 public:
  WatchedFilter(base_filter* filter, const Place& place)
      : base_filter(ModeOf(*filter)),
        filter_(filter),
        place_(place),
        pipeline_(const_cast<filter_node*>(place.pipeline)),
        left_(static_cast<char*>(pipeline_) + 1) {}
  ~WatchedFilter() override {
    filter_->~base_filter();
    tbb::detail::r1::deallocate_memory(filter_);
  }

  void* operator()(void* item) override {
    if (is_serial()) __tsan_acquire(this);
    if (place_.first) __tsan_acquire(left_);
    if (item != nullptr) __tsan_acquire(item);
    base_filter* const outer = std::exchange(running, this);
    item = (*filter_)(item);
    running = outer;
    if (item != nullptr) __tsan_release(item);
    if (is_serial()) __tsan_release(this);
    if (place_.last) __tsan_release(left_);
    __tsan_release(pipeline_);
    return item;
  }
  void finalize(void* item) override { filter_->finalize(item); }

  static thread_local base_filter* running;

 private:
  base_filter* filter_;
  Place place_;
  void* pipeline_;
  void* left_;  // An address for the items that have left.
};
thread_local base_filter* WatchedFilter::running = nullptr;

// The node of a wrapped filter.
class WatchedLeaf final : public filter_node {
 public:
  WatchedLeaf(const filter_node& leaf, const Place& place) : leaf_(leaf), place_(place) {}
  base_filter* create_filter() const override {
    return new (tbb::detail::r1::allocate_memory(sizeof(WatchedFilter))) WatchedFilter(leaf_.create_filter(), place_);
  }

 private:
  const filter_node& leaf_;
  Place place_;
};

filter_node* Watched(const filter_node& node, const Place& place) {
  using tbb::detail::r1::allocate_memory;
  if (!node.left) return new (allocate_memory(sizeof(WatchedLeaf))) WatchedLeaf(node, place);
  return new (allocate_memory(sizeof(filter_node)))
      filter_node(Watched(*node.left, {place.pipeline, place.first, false}),
                  Watched(*node.right, {place.pipeline, false, place.last}));
}

}  // namespace

namespace tbb::detail::r1 {

void parallel_pipeline(task_group_context& context, std::size_t tokens, const filter_node& filters) {
  static const auto next = NextFunction<void(task_group_context&, std::size_t, const filter_node&)>(
      "_ZN3tbb6detail2r117parallel_pipelineERNS0_2d118task_group_contextEmRKNS2_11filter_nodeE");
  const d1::filter_node_ptr watched(Watched(filters, {&filters}));
  next(context, tokens, *watched);
  __tsan_acquire(const_cast<filter_node*>(&filters));
}

void set_end_of_input(base_filter&) {
  static const auto next =
      NextFunction<void(base_filter&)>("_ZN3tbb6detail2r116set_end_of_inputERNS0_2d111base_filterE");
  next(*WatchedFilter::running);
}

}  // namespace tbb::detail::r1
