/* Pages for users come before decisions, results and modules for authors of planners in the search. */

const RESEARCH =
  /^(decisions|results|changelog|tested|space|api\/(assign|bench|cyclic|facts|kinds|native|plan_work|precedence|search))/;

globalThis.Scorer = {
  score: ([page, , , , score]) => (RESEARCH.test(page) ? score - 10 : score),
  objNameMatch: 11,
  objPartialMatch: 2,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
