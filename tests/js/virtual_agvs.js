/** Robots of another project: virtual AGVs of vda-5050-lib, for test_foreign_robots.py. */
import lib from "vda-5050-lib";

const { AgvController, VirtualAgvAdapter } = lib;

/** What the first argument is. @typedef {{
 *   broker: string,
 *   timeLapse: number,
 *   robots: { manufacturer: string, serialNumber: string, place: string, x: number, y: number }[],
 * }} Fleet */

/** @type {Fleet} */
const fleet = JSON.parse(process.argv[2] ?? "{}");

for (const { manufacturer, serialNumber, place, x, y } of fleet.robots) {
  const controller = new AgvController(
    { manufacturer, serialNumber },
    { interfaceName: "uagv", transport: { brokerUrl: fleet.broker }, vdaVersion: "2.0.0" },
    {
      agvAdapterType: VirtualAgvAdapter,
      publishVisualizationInterval: 0,
      publishStateInterval: 1000,
    },
    {
      initialPosition: { mapId: "map", x, y, theta: 0, lastNodeId: place },
      tickRate: 50,
      timeLapse: fleet.timeLapse,
      vehicleSpeed: 10,
    },
  );
  await controller.start();
}
console.log("up");
