// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/paper/figures.h"

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {
namespace {

// Figure 5 lacks "_rmse" in its file names and has "_edges" in one; figure 6 has "_ocf".
std::vector<FigureCurve> FiveMetrics(const std::string& prefix, const std::string& edge_suffix,
                                     const std::string& suffix, Variant variant,
                                     const std::string& legend_suffix) {
  return {{prefix + "EDGEEDGELINESEGMENT" + edge_suffix, "edge_to_line", variant,
           "edge point to edge line" + legend_suffix, "orange", "dashed"},
          {prefix + "PLANARPLANAR" + suffix, "planar_to_patch", variant,
           "planar point to planar patch" + legend_suffix, "green", "solid"},
          {prefix + "SYMM" + suffix, "symmetric", variant,
           "symmetric objective function" + legend_suffix, "cyan", "dashdotted"},
          {prefix + "POINT_PLANE" + suffix, "point_to_plane", variant,
           "point-to-plane" + legend_suffix, "violet", "dashed"},
          {prefix + "POINT_POINT" + suffix, "point_to_point", variant,
           "point-to-point" + legend_suffix, "blue", "solid"}};
}

std::vector<Figure> MakeFigures() {
  const std::string point = "point_to_point";
  return {
      {"00_1500", "straight_street", "00", 1500,
       FiveMetrics("0_1500_", "_rmse", "_rmse", Variant::kPlain, ""), std::pair(0.1, 0.9)},
      {"00_100", "right_turn", "00", 100,
       FiveMetrics("0_100_", "_rmse", "_rmse", Variant::kPlain, ""), std::nullopt},
      {"01_320", "highway", "01", 320, FiveMetrics("1_320_", "_rmse", "_rmse", Variant::kPlain, ""),
       std::nullopt},
      {"01_320_improved",
       "highway",
       "01",
       320,
       {{"1_320_POINT_POINT_offlineOverlap_6", point, Variant::kEgoFilter,
         "point-to-point + ego overlap filter", "violet", "dashed"},
        {"1_320_POINT_POINT_reciprocal", point, Variant::kReciprocal,
         "point-to-point reciprocal corr.", "cyan", "dashdotted"},
        {"1_320_POINT_POINT_rmse", point, Variant::kPlain, "point-to-point", "blue", "solid"},
        {"1_320_POINT_POINT_blind_spot", point, Variant::kBlindSpot,
         "point-to-point with the artificial blind spot alone", "gray", "solid", false}},
       std::nullopt},
      {"01_420", "highway_overtaking", "01", 420,
       FiveMetrics("1_420_", "_edges", "", Variant::kPlain, ""), std::nullopt},
      {"01_420_octree", "highway_overtaking", "01", 420,
       FiveMetrics("1_420_", "_ocf_rmse", "_ocf_rmse", Variant::kOctree, " + OCF"), std::nullopt}};
}

}  // namespace

const std::vector<Figure>& PaperFigures() {
  static const std::vector<Figure> figures = MakeFigures();
  return figures;
}

const std::vector<std::string>& PaperMetrics() {
  static const std::vector<std::string> metrics = {"edge_to_line", "planar_to_patch", "symmetric",
                                                   "point_to_plane", "point_to_point"};
  return metrics;
}

std::vector<Figure> FiguresFromName(const std::string& name) {
  if (name == "all") {
    return PaperFigures();
  }
  std::vector<std::string> names = {"all"};
  for (const Figure& figure : PaperFigures()) {
    names.push_back(figure.name);
  }
  return {PaperFigures()[IndexOfName("figure", name, names) - 1]};
}

std::string StandaloneLatex(const Figure& figure) {
  std::string text =
      "\\documentclass{article}\n"
      "\\usepackage{pgfplots}\n"
      "\\pgfplotsset{compat=1.9, every axis/.append style={font=\\footnotesize}}\n"
      "\\newsavebox{\\figurebox}\n"
      "\\begin{document}\n"
      "\\begin{lrbox}{\\figurebox}%\n"
      "\\begin{tikzpicture}\n"
      "  \\begin{axis}[\n"
      "    width=119mm, height=85mm,\n"
      "    xlabel={Interpolation parameter $ u $}, ylabel={RMSE($ \\epsilon $)},\n"
      "    xmin=-1, xmax=2,\n";
  if (figure.y_range) {
    text += "    ymin=" + Number(figure.y_range->first) +
            ", ymax=" + Number(figure.y_range->second) + ",\n";
  }
  text +=
      "    xmajorgrids=true, ymajorgrids=false, major grid style={dashed},\n"
      "    xtick={-1, 0, 1, 2}, minor xtick={-0.5, 0.5, 1.5},\n"
      "    ylabel shift=4pt, legend cell align=left,\n"
      "  ]\n";
  for (const FigureCurve& curve : figure.curves) {
    if (curve.in_paper) {
      text += "    \\addplot[color=" + curve.color + ", style=" + curve.style + "] table{data/" +
              curve.file + ".txt};\n    \\addlegendentry{" + curve.legend + "}\n";
    }
  }
  text +=
      "  \\end{axis}\n"
      "\\end{tikzpicture}%\n"
      "\\end{lrbox}\n"
      "% A page as large as the figure.\n"
      "\\pdfhorigin=2pt \\pdfvorigin=2pt \\hoffset=0pt \\voffset=0pt\n"
      "\\pdfpagewidth=\\dimexpr\\wd\\figurebox+4pt\\relax\n"
      "\\pdfpageheight=\\dimexpr\\ht\\figurebox+\\dp\\figurebox+4pt\\relax\n"
      "\\shipout\\box\\figurebox\n"
      "\\end{document}\n";
  return text;
}

}  // namespace icpscape
