start_theme();
document.documentElement.dataset.ready = "true";
