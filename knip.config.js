/** Exports that nobody imports, files that no page begins with or imports, imports of what is not there. */
export default {
  entry: [
    "src/rightofway/viz/page/assets/{main,jobs_main,shift_main,inspect_main,watch_main,widget}.js",
    "src/rightofway/studio/assets/{main,stream}.js",
    "tests/js/{virtual_agvs,**/*.test}.js",
  ],
  project: ["src/rightofway/{viz/page,studio}/assets/**/*.js", "tests/js/**/*.js"],
  ignore: ["src/rightofway/studio/assets/vendor/**"],
};
