"""Commands of fleet control: `drive`, `jobs` and `robots`; `rightofway.cli.parts` lists them."""
