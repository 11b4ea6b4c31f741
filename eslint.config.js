import js from "@eslint/js";
import globals from "globals";

const ASSETS = "src/rightofway/{viz/page,studio}/assets";

/** What prettier and tsc do not see: names that nobody reads or that hide others, and loose habits. */
export default [
  { ignores: ["**/vendor/"] }, // `just lint` names the files of the repository
  { ...js.configs.recommended, files: ["**/*.js"] },
  {
    files: ["**/*.js"],
    languageOptions: { ecmaVersion: 2023 },
    linterOptions: { reportUnusedDisableDirectives: "error" },
    rules: {
      eqeqeq: "error",
      "no-shadow": "error",
      "no-unused-vars": ["error", { ignoreRestSiblings: true, varsIgnorePattern: "^_$" }],
      "no-use-before-define": ["error", { functions: false, classes: false, variables: false }],
      "no-var": "error",
      "object-shorthand": "error",
      "prefer-const": "error",
    },
  },
  { files: [`${ASSETS}/**/*.js`], languageOptions: { globals: globals.browser } },
  {
    // The frame that the notebook puts round all modules, see viz/page/widget.py.
    files: [`${ASSETS}/widget.js`],
    languageOptions: { globals: { SHELL: "readonly" } },
  },
  { files: ["tests/js/**/*.js"], languageOptions: { globals: globals.node } },
];
