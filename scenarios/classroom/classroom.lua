-- SPDX-License-Identifier: Apache-2.0
-- The flag of a robot stands at the other end of its lane. Who reaches it is noted, with the time.
local kFlag_x = 7.5
memory.there = {}
memory.count = 0

function on_step(t)
  for lane = 1, 10 do
    local robot = "robot-" .. lane
    if not memory.there[robot] and distance(robot, {kFlag_x, lane - 1}) < 0.4 then
      memory.there[robot] = t
      memory.count = memory.count + 1
      mark(string.format("%s is at its flag after %.1f s, as number %d", robot, t, memory.count))
      if memory.count == 10 then finish("success", "all robots are at their flags") end
    end
  end
end
