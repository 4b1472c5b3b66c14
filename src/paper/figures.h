// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_PAPER_FIGURES_H_
#define ICPSCAPE_SRC_PAPER_FIGURES_H_

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace icpscape {

/// What is done to the pair before or while it is matched.
enum class Variant {
  kPlain,
  kReciprocal,  ///< Strict reciprocal correspondences [paper sec. 2.5].
  kBlindSpot,   ///< Only the artificial blind spot: the fair baseline of the next.
  kEgoFilter,   ///< Artificial blind spot, then ego blind spot filter [sec. 2.6 and 4.2].
  kOctree,      ///< Octree Correspondence Filter [sec. 2.7].
};

/// One curve of a figure, as the paper's TeX source sets it.
struct FigureCurve {
  std::string file;  ///< data/FILE.txt, the paper's own name.
  std::string metric;
  Variant variant;
  std::string legend;
  std::string color;     ///< xcolor's name.
  std::string style;     ///< solid, dashed or dashdotted.
  bool in_paper = true;  ///< The others are only ours: thin and grey, not in the TeX files.
};

/// One of the paper's six result figures.
struct Figure {
  std::string name;                 ///< The label of the paper: "00_1500".
  std::string scene;                ///< Simulated, with the motion of the frame.
  std::string sequence;             ///< KITTI.
  int frame;                        ///< The source; the target is the frame before.
  std::vector<FigureCurve> curves;  ///< In the order of the legend.
  std::optional<std::pair<double, double>> y_range;
};

/// In the paper's order: 00_1500, 00_100, 01_320, 01_320_improved, 01_420, 01_420_octree.
const std::vector<Figure>& PaperFigures();

/// The five metrics in the order of the paper's legends.
const std::vector<std::string>& PaperMetrics();

/// The figures of that name, or all of them. Throws UsageError naming what there is.
std::vector<Figure> FiguresFromName(const std::string& name);

/// A LaTeX document of its own (pgfplots, no other package) that reads data/ beside it; its page is
/// as large as the figure. The axes are the paper's.
std::string StandaloneLatex(const Figure& figure);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_PAPER_FIGURES_H_
