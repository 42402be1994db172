-- SPDX-License-Identifier: Apache-2.0
-- Each truck follows the one before it, as long as nothing else was asked of its team: twice a second it
-- is sent to where that truck is, and stands when it is near.
local behind = {["truck-2"] = "truck-1", ["truck-4"] = "truck-3"}
memory.next = 0

function on_step(t)
  if t < memory.next then return end
  memory.next = t + 0.5
  for truck, before in pairs(behind) do
    local far = distance(truck, before) > 1.1
    if far then goal{robot = truck, point = {x(before), y(before)}} end
    if not far and speed(truck) > 0.05 then cancel{robot = truck} end
  end
end
