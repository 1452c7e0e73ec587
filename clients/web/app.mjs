document.getElementById("app").textContent = "Gnomon";
