local t = setmetatable({}, {__index = function(s, k) return k end, __close = print})
for k, v in pairs({a = 1, [2] = 3}) do host(k, v) end
print(("abc"):gsub("(%w)(.-)", "%2%1"), ("x(y)z"):find("%b()"), ("a b"):match("%f[%w]%w+"), string.format("%q %5.1f", "x", 2))
pcall(error, {}) xpcall(host, print, t, table.unpack({1, 2, 3})) goto done
do local x <close> = t end ::done::
table.sort({3, 2, 1}, function(a, b) return a > b end) return select(-1, 1, 2), #t, ("x"):rep(10, ","), 1 // 1, 2 ^ 0.5, 7 & 3
