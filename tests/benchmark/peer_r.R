# The fit of recoil's benchmark as a careful user of R would write it: deSolve's lsodar, which stops
# at roots, minpack.lm::nls.lm on weighted residuals, and boot for a few refits.
#
#     Rscript peer_r.R FOLDER
#
# FOLDER holds points.csv and constants.csv, which recoil_benchmark writes; peer_r.csv is left
# there. The equation is that of Li, Dunn & Brach (1999) with damping that takes energy out, as in
# peer_lmfit.py, and written down anew.

suppressPackageStartupMessages({
  library(deSolve)
  library(minpack.lm)
  library(boot)
})

folder <- commandArgs(trailingOnly = TRUE)[1]
points <- read.csv(file.path(folder, "points.csv"))
constants <- as.list(read.csv(file.path(folder, "constants.csv")))
start <- c(C_H = constants$start_C_H, C_A = constants$start_C_A, f0 = constants$start_f0)

tolerance <- 1e-10   # of the integrator
differences <- 1e-8  # epsfcn of nls.lm: steps of 1e-4, much longer than the integrator's errors
replicates <- 2

radius <- 0.5e-6 * points$diameter
mass <- constants$density * 4 / 3 * pi * radius^3
length_scale <- (points$incident_velocity^2 * mass / (sqrt(radius) * constants$stiffness))^0.4
# The adhesive acceleration per f0, in units of velocity^2 / length.
adhesion <- 2 * pi * sqrt(radius * length_scale) * length_scale / (mass * points$incident_velocity^2) *
  (2 * radius / constants$reference_diameter)^(1 / 3)

motion <- function(t, y, p) {
  depth <- if (y[1] > 0) y[1] else 0
  root <- sqrt(depth)
  outward <- if (y[2] < 0) -y[2] else 0
  list(c(y[2], -root * depth * (1 + p[1] * y[2]) + p[2] * root * (1 + p[3] * outward)))
}
turning <- function(t, y, p) y[2]
leaving <- function(t, y, p) c(y[1], y[2])

# The state at the first root; lsodar stops there.
until <- function(y, p, root) {
  last <- lsodar(y, c(0, 1e4), motion, p, rootfunc = root, rtol = tolerance, atol = 1e-2 * tolerance,
                 maxsteps = 1e5)
  last[nrow(last), 2:3]
}

# Mechanical energy at the end over the incident kinetic energy: e^2, continued below capture.
restitution_squared <- function(i, theta) {
  v <- points$incident_velocity[i]
  beta <- adhesion[i] * theta[["f0"]]
  p <- c(theta[["C_H"]] * v, beta, theta[["C_A"]] * v)
  deepest <- until(c(0, 1), p, turning)
  end <- until(c(deepest[1], 0), p, leaving)
  depth <- max(end[1], 0)
  unname(end[2]^2 + 0.8 * depth^2.5 - 4 / 3 * beta * depth^1.5)
}

predict_all <- function(theta) vapply(seq_len(nrow(points)), restitution_squared, 0, theta = theta)

residuals_of <- function(theta, data) {
  model <- predict_all(theta)
  variance <- data$restitution_sd^2
  root <- sqrt(pmax(0, 0.5 * (model + sqrt(model^2 + variance^2))))
  (data$restitution^2 - variance - model) /
    (data$restitution_sd * sqrt((data$restitution + root)^2 + 2 * variance))
}

fit_of <- function(data, from) {
  nls.lm(par = from, lower = c(0, 0, 0), fn = residuals_of, data = data,
         control = nls.lm.control(epsfcn = differences, ftol = 1.5e-8, ptol = 1.5e-8))
}

seconds <- system.time(fit <- fit_of(points, start))[["elapsed"]]
mean_restitution <- sqrt(pmax(predict_all(coef(fit)), 0))
bootstrap_seconds <- system.time(
  again <- boot(points, function(data) coef(fit_of(data, coef(fit))), R = replicates, sim = "parametric",
                ran.gen = function(data, mle) {
                  data$restitution <- rnorm(nrow(data), mle, data$restitution_sd)
                  data
                }, mle = mean_restitution)
)[["elapsed"]]
stopifnot(all(is.finite(again$t)))

error <- sqrt(diag(solve(fit$hessian)))
result <- data.frame(
  seconds = seconds, iterations = fit$niter, chi2 = fit$deviance, code = fit$info,
  C_H = coef(fit)[["C_H"]], C_A = coef(fit)[["C_A"]], f0 = coef(fit)[["f0"]],
  se_C_H = error[[1]], se_C_A = error[[2]], se_f0 = error[[3]],
  tolerance = tolerance, replicates = replicates, boot_seconds = bootstrap_seconds,
  R = paste(R.version$major, R.version$minor, sep = "."),
  deSolve = as.character(packageVersion("deSolve")),
  minpack.lm = as.character(packageVersion("minpack.lm")),
  boot = as.character(packageVersion("boot"))
)
options(digits = 17)
write.csv(result, file.path(folder, "peer_r.csv"), row.names = FALSE)
