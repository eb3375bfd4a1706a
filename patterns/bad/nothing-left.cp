2 0 0 NaN 1
