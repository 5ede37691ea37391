# Makes simulated_study.csv, a SIMULATED study of 15 invented participants, and what R says about
# it, simulated_study_r.json. Both are stored; the tests only read them.
#
#   Rscript simulated_study.R data        writes simulated_study.csv
#   Rscript simulated_study.R reference   reads it and writes simulated_study_r.json
#
# Needs R with the packages coin, exactRankTests and jsonlite (Debian: r-base-core, r-cran-coin,
# r-cran-exactranktests, r-cran-jsonlite).

simulate <- function() {
  RNGversion("4.0.0")
  set.seed(2023)
  mean_of <- list(Q1 = c(none = 3.0, nade = 5.2), Q2 = c(none = 4.5, nade = 5.3),
                  Q3 = c(none = 3.5, nade = 5.0))
  shift <- c(plane = 0.2, sphere = 0, dog = -0.3)
  conditions <- expand.grid(object = names(shift), method = c("none", "nade"),
                            stringsAsFactors = FALSE)
  rows <- list()
  for (person in 1:15) {
    lenient <- rnorm(1, 0, 0.5)
    shuffled <- conditions[sample(nrow(conditions)), ]
    for (trial in seq_len(nrow(shuffled))) {
      object <- shuffled$object[trial]
      method <- shuffled$method[trial]
      for (question in names(mean_of)) {
        felt <- mean_of[[question]][[method]] + shift[[object]] + lenient + rnorm(1, 0, 1.4)
        rows[[length(rows) + 1]] <- data.frame(
          participant = sprintf("S%02d", person), trial = trial, order = trial,
          object = object, method = method, question = question,
          answer = min(7, max(1, round(felt))),
          response_time_s = sprintf("%.3f", exp(rnorm(1, log(3), 0.4))),
          attempt = 1, status = "given", simulated = "SIMULATED")
      }
    }
  }
  write.csv(do.call(rbind, rows), "simulated_study.csv", row.names = FALSE, quote = FALSE)
}

# Each person's answer, or the average over the objects where `object` is empty.
values_of <- function(data, question, object, method) {
  some <- data[data$question == question & data$method == method &
                 (object == "" | data$object == object), ]
  tapply(some$answer, some$participant, mean)
}

compare <- function(data, question, object) {
  before <- values_of(data, question, object, "none")
  after <- values_of(data, question, object, "nade")
  d <- round(after - before, 9) # so that what is equal is a tie
  # As wilcox.test warns, it takes the approximation under ties and zeros whatever is asked for.
  r <- wilcox.test(d, exact = FALSE, correct = TRUE)
  coin_p <- function(zeros) {
    test <- coin::wilcoxsign_test(d ~ rep(0, length(d)), distribution = "exact",
                                  zero.method = zeros)
    as.numeric(coin::pvalue(test))
  }
  pratt_rank <- rank(abs(d))
  pratt <- d != 0
  dropped_rank <- rank(abs(d[pratt]))
  used <- d[pratt]
  w_plus <- sum(dropped_rank[used > 0])
  w_minus <- sum(dropped_rank[used < 0])
  stopifnot(isTRUE(all.equal(unname(r$statistic), w_plus)))
  list(question = question, object = object, n = length(d), zeros = sum(d == 0),
       none = unname(quantile(before, c(0.25, 0.5, 0.75), type = 7)),
       nade = unname(quantile(after, c(0.25, 0.5, 0.75), type = 7)),
       w_plus = w_plus, p_cc = r$p.value,
       p_exact = coin_p("Wilcoxon"),
       p_exact_exactRankTests =
         exactRankTests::wilcox.exact(used, exact = TRUE)$p.value,
       w_plus_pratt = sum(pratt_rank[d > 0]), p_exact_pratt = coin_p("Pratt"),
       rank_biserial = (w_plus - w_minus) / (w_plus + w_minus))
}

reference <- function() {
  data <- read.csv("simulated_study.csv")
  family <- function(objects) {
    tests <- list()
    for (object in objects) {
      for (question in c("Q1", "Q2", "Q3")) {
        tests[[length(tests) + 1]] <- compare(data, question, object)
      }
    }
    adjusted <- p.adjust(sapply(tests, function(t) t$p_exact), "holm")
    adjusted_pratt <- p.adjust(sapply(tests, function(t) t$p_exact_pratt), "holm")
    for (i in seq_along(tests)) {
      tests[[i]]$p_holm <- adjusted[i]
      tests[[i]]$p_holm_pratt <- adjusted_pratt[i]
    }
    tests
  }
  result <- list(
    about = "SIMULATED answers (simulated_study.csv) as R sees them; made by simulated_study.R",
    R = R.version.string, coin = as.character(packageVersion("coin")),
    exactRankTests = as.character(packageVersion("exactRankTests")),
    averaged = family(""), by_object = family(c("plane", "sphere", "dog")))
  jsonlite::write_json(result, "simulated_study_r.json", auto_unbox = TRUE, digits = 15,
                       pretty = TRUE)
}

switch(commandArgs(trailingOnly = TRUE)[1], data = simulate(), reference = reference())
