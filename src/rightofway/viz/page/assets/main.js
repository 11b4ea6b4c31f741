import { createPlayer } from "./player.js";

const data = document.getElementById("plan");
if (!data) throw new Error("page: there is no plan (look at the template)");
createPlayer(document.body, JSON.parse(data.textContent));
