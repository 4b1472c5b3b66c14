// SPDX-License-Identifier: BSD-3-Clause
#include "apps/reports/paper_figures.h"

#include <algorithm>
#include <iostream>

#include "icpscape/common/text.h"
#include "icpscape/io/output.h"
#include "icpscape/paper/predicates.h"

namespace icpscape {
namespace {

// One cell of a table whose cells are separated by commas.
std::string WithoutCommas(std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

void WritePaperTables(const std::vector<Figure>& figures,
                      const std::map<std::string, std::string>& titles,
                      const std::map<std::string, PaperCurve>& curves, Run* run) {
  Table list({"figure", "title", "file", "legend", "color", "style", "in_paper", "y_min", "y_max"});
  Table minima({"figure", "file", "metric", "argmin_u", "local_minima", "rmse", "n"});
  Table pulls({"figure", "file", "group", "n_0", "eps_0", "n_1", "eps_1"});
  for (const Figure& figure : figures) {
    for (const FigureCurve& curve : figure.curves) {
      const PaperCurve& found = curves.at(curve.file);
      Table table({"u", "rmse"});
      for (const CurvePoint& point : found.curve.points) {
        table.AddRow({Number(point.u), Number(point.rmse)});
      }
      table.WritePgfplots(run->File("data/" + curve.file + ".txt"));
      list.AddRow({figure.name, WithoutCommas(titles.at(figure.name)), curve.file, curve.legend,
                   curve.color, curve.style, curve.in_paper ? "1" : "0",
                   figure.y_range ? Number(figure.y_range->first) : "",
                   figure.y_range ? Number(figure.y_range->second) : ""});
      const CurvePoint& least = found.curve.Minimum();
      minima.AddRow({figure.name, curve.file, curve.metric, Number(least.u),
                     std::to_string(LocalMinima(found.curve).size()), Number(least.rmse),
                     Number(least.n)});
      for (const Pull& pull : found.pulls) {
        pulls.AddRow({figure.name, curve.file, pull.group, Number(pull.n_0), Number(pull.epsilon_0),
                      Number(pull.n_1), Number(pull.epsilon_1)});
      }
    }
    WriteTextFile(run->File(figure.name + ".tex"), StandaloneLatex(figure));
  }
  list.WriteCsv(run->File("figures.csv"));
  minima.WriteCsv(run->File("minima.csv"));
  pulls.WriteCsv(run->File("pulls.csv"));
}

void ReportClaims(const std::vector<Claim>& claims, const std::string& source, Run* run) {
  Table table({"id", "claim", "measured", "outcome"});
  for (const Claim& claim : claims) {
    table.AddRow({claim.id, claim.statement, claim.measured, OutcomeName(claim.outcome)});
    run->manifest()->SetResult("claim_" + claim.id, OutcomeName(claim.outcome));
    if (claim.outcome != Claim::Outcome::kNotDrawn) {
      std::cout << claim.id << ": " << OutcomeName(claim.outcome) << ": " << claim.statement << " ["
                << claim.measured << "]\n";
    }
  }
  table.WriteCsv(run->File("claims.csv"));
  WriteTextFile(run->File("claims.md"), ClaimsMarkdown(claims, source));
}

}  // namespace icpscape
