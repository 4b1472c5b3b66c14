#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Compiles figures with LaTeX (tools/setup.sh --with-latex installs it):
#   tools/compile_figures.sh FILE.tex DATA_DIR OUT
# takes every tikzpicture of FILE.tex that reads tables from data/, unchanged, with the file's own
# settings of pgfplots, compiles each against DATA_DIR and writes OUT/FILE_1.pdf, FILE_2.pdf, ... A
# file that holds one such picture, as icpscape-paper_figures writes them, becomes OUT/FILE_1.pdf.
set -euo pipefail

fail() {
  echo "compile_figures.sh: $1" >&2
  exit "$2"
}

[ $# -eq 3 ] || fail "$# arguments; expected FILE.tex DATA_DIR OUT." 1
[ -r "$1" ] || fail "$1: cannot be read." 2
[ -d "$2" ] || fail "$2: no such folder; expected the data/ of icpscape-paper_figures." 2
command -v pdflatex >/dev/null || fail "no pdflatex; expected tools/setup.sh --with-latex before." 2
name=$(basename "$1" .tex)
data=$(cd "$2" && pwd)
mkdir -p "$3"
out=$(cd "$3" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
ln -s "$data" "$work/data"

# settings.tex: the preamble's \pgfplotsset{...} and \usetikzlibrary{...}, by counting braces.
# figure_N.tex: the pictures.
awk -v work="$work" '
  /\\begin\{document\}/ { body = 1 }
  !body && (depth > 0 || /\\pgfplotsset|\\usetikzlibrary/) {
    print > (work "/settings.tex")
    depth += gsub(/\{/, "{") - gsub(/\}/, "}")
  }
  /\\begin\{tikzpicture\}/ { inside = 1; picture = "" }
  inside { picture = picture $0 "\n" }
  /\\end\{tikzpicture\}/ {
    inside = 0
    if (picture ~ /table *(\[[^]]*\])? *\{data\//) {
      printf "%s", picture > (work "/figure_" ++count ".tex")
    }
  }' "$1"
touch "$work/settings.tex"

count=$(find "$work" -name 'figure_*.tex' | wc -l)
[ "$count" -gt 0 ] || fail "$1: no tikzpicture reads a table from data/." 2
for ((i = 1; i <= count; ++i)); do
  cat >"$work/page.tex" <<END
\\documentclass{article}
\\usepackage{pgfplots}
\\input{settings}
\\newsavebox{\\figurebox}
\\begin{document}
\\begin{lrbox}{\\figurebox}\\input{figure_$i}\\unskip\\end{lrbox}
\\pdfhorigin=2pt \\pdfvorigin=2pt \\hoffset=0pt \\voffset=0pt
\\pdfpagewidth=\\dimexpr\\wd\\figurebox+4pt\\relax
\\pdfpageheight=\\dimexpr\\ht\\figurebox+\\dp\\figurebox+4pt\\relax
\\shipout\\box\\figurebox
\\end{document}
END
  (cd "$work" && pdflatex -interaction=batchmode -halt-on-error page.tex >/dev/null) || {
    reason=$(grep -m1 -A1 '^!' "$work/page.log" 2>/dev/null | tr '\n' ' ' || true)
    fail "$1: figure $i does not compile: ${reason:-see pdflatex}" 3
  }
  mv "$work/page.pdf" "$out/${name}_$i.pdf"
done
echo "compiled $count figures of $1 into $out"
