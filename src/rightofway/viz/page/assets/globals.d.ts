// What the frame of the notebook has, see viz/page/widget.py: the style, and the element of the page.
declare const SHELL: string;
