// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <utility>

#include "tests/benchmarks/check.h"
#include "tests/benchmarks/comparison.h"
#include "tests/benchmarks/nanoflann_peer.h"
#include "tests/benchmarks/nearest.h"
#include "tests/benchmarks/open3d_peer.h"
#include "tests/benchmarks/pcl_peer.h"
#include "tests/benchmarks/rows.h"

namespace icpscape {
namespace {

// The scan at one pose, and what all sides need to search for it in the target.
struct Work {
  Work(const PointCloud& source, const PointCloud& target_cloud, const SE3d& T)
      : target(target_cloud),
        in_file_order(source.Transformed(T)),
        order(NeighborSearch(source.View()).Order()),
        in_tree_order(Reordered(in_file_order, order)),
        ours(in_file_order.size()),
        theirs(in_file_order.size()) {}

  const PointCloud& target;
  PointCloud in_file_order;
  std::vector<std::int32_t> order;
  PointCloud in_tree_order;
  NearestResult ours;    // In the tree's order.
  NearestResult theirs;  // In the file's order.

  NearestResult OursInFileOrder() const {
    NearestResult out(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      out.index[static_cast<std::size_t>(order[i])] = ours.index[i];
      out.squared_distance[static_cast<std::size_t>(order[i])] = ours.squared_distance[i];
    }
    return out;
  }
};

// Searches whose trees are built and whose queries are ordered.
void RegisterSearches(const BenchmarkPair& pair, const std::string& pose, const SE3d& T,
                      int rounds) {
  const auto work = std::make_shared<Work>(pair.source, pair.target, T);
  const auto tree = std::make_shared<NeighborSearch>(pair.target.View());
  const auto nanoflann = std::make_shared<NanoflannTree>(pair.target);
  const PclCloud pcl_queries = MakePclCloud(work->in_file_order);
  const auto pcl = std::make_shared<PclTree>(MakePclCloud(pair.target));
  const auto add = [&](const std::string& name, const std::string& peer, bool is_main, int threads,
                       double tolerance, std::function<void()> run_peer) {
    Comparison row;
    row.name = "nearest/" + pose + "/" + ThreadsName(threads) + "/" + name;
    row.title = "1-NN, " + pose + " pose, " + ThreadsTitle(threads);
    row.is_main = is_main;
    row.ours = {"icpscape",
                [=] { NearestOfAll(*tree, work->in_tree_order, threads, &work->ours); }};
    row.peer = {peer, std::move(run_peer)};
    row.check = [=] {
      CheckNearest(peer, work->target, work->in_file_order, work->OursInFileOrder(), work->theirs,
                   tolerance);
    };
    Register(row, rounds);
  };
  for (const int threads : {1, 2}) {
    add("nanoflann", "nanoflann", threads == 1, threads, 0,
        [=] { nanoflann->Nearest(work->in_file_order, threads, &work->theirs); });
    add("pcl", "PCL", threads == 1 && FromAvx2(), threads, 0,
        [=] { pcl->Nearest(pcl_queries, threads, &work->theirs); });
    if (!Open3dVersion().empty()) {
      const Open3dCloud queries = MakeOpen3dCloud(work->in_file_order);
      const auto open3d = std::make_shared<Open3dTree>(MakeOpen3dCloud(pair.target));
      // It computes in double.
      add("open3d", "Open3D", false, threads, 1e-5,
          [=] { open3d->Nearest(queries, threads, &work->theirs); });
    }
  }
  // What only the order of the queries brings.
  const auto ordered = std::make_shared<NearestResult>(work->order.size());
  Comparison row;
  row.name = "nearest/" + pose + "/t1/nanoflann_in_our_order";
  row.title = "1-NN, " + pose + " pose, 1 thread";
  row.ours = {"icpscape", [=] { NearestOfAll(*tree, work->in_tree_order, 1, &work->ours); }};
  row.peer = {"nanoflann, queries in our order",
              [=] { nanoflann->Nearest(work->in_tree_order, 1, ordered.get()); }};
  row.check = [=] {
    CheckNearest("nanoflann", work->target, work->in_tree_order, work->ours, *ordered, 0);
  };
  Register(row, rounds);
}

// What must be done before the first search.
void RegisterTrees(const BenchmarkPair& pair, int rounds) {
  const PointCloud& target = pair.target;
  const Side ours = {"icpscape", [&target] { const NeighborSearch search(target.View()); }};
  Register({"nearest/build/nanoflann",
            "tree of the target",
            false,
            ours,
            {"nanoflann", [&target] { const NanoflannTree tree(target); }}},
           rounds);
  const PclCloud pcl_target = MakePclCloud(target);
  Register({"nearest/build/pcl",
            "tree of the target",
            false,
            ours,
            {"PCL", [=] { const PclTree tree(pcl_target); }}},
           rounds);
  if (!Open3dVersion().empty()) {
    const Open3dCloud open3d_target = MakeOpen3dCloud(target);
    Register({"nearest/build/open3d",
              "tree of the target",
              false,
              ours,
              {"Open3D", [=] { const Open3dTree tree(open3d_target); }}},
             rounds);
  }
  const PointCloud& source = pair.source;
  Register({"nearest/order",
            "ordering the queries",
            false,
            {"icpscape", [&source] { Reordered(source, NeighborSearch(source.View()).Order()); }},
            {}},
           rounds);
  // Everything, for a cloud that is searched for only once.
  const auto work = std::make_shared<Work>(source, target, SE3d());
  Register({"nearest/whole/nanoflann",
            "1-NN, identity pose, 1 thread, with tree and ordering",
            false,
            {"icpscape",
             [=] {
               const NeighborSearch search(work->target.View());
               const PointCloud queries = Reordered(
                   work->in_file_order, NeighborSearch(work->in_file_order.View()).Order());
               NearestOfAll(search, queries, 1, &work->ours);
             }},
            {"nanoflann",
             [=] {
               const NanoflannTree tree(work->target);
               tree.Nearest(work->in_file_order, 1, &work->theirs);
             }}},
           rounds);
}

}  // namespace

void RegisterNeighborSearch(const BenchmarkPair& pair, int rounds) {
  RegisterSearches(pair, "identity", SE3d(), rounds);
  RegisterSearches(pair, "true", *pair.T_ground_truth, rounds);
  RegisterTrees(pair, rounds);
}

}  // namespace icpscape
