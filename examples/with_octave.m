% The best settled setting of a portrait with Ms <= 2, by Octave with its package netcdf.
%
% usage: octave-cli with_octave.m FILE.h5

pkg load netcdf
file = argv(){1};

% netCDF's first dimension is the last one here: a column runs over the portrait's axes from the last to the first.
objective = ncread(file, "IAE_w") + ncread(file, "IAE_d");
admissible = ncread(file, "status") == 1 & ncread(file, "Ms") <= 2;
objective(! admissible) = NaN;
[best, place] = min(objective(:));

axes = strsplit(ncreadatt(file, "/", "grid_axes"), " ");
index = cell(1, numel(axes));
sizes = size(objective);
if numel(axes) > 1
  [index{:}] = ind2sub(sizes, place);
else
  index = {place};
end
printf("%.6g", best);
for k = 1:numel(axes)
  values = ncread(file, axes{k});
  printf(" %s=%g", axes{k}, values(index{numel(axes) + 1 - k}));
end
printf("\n");
