//! temp
fn main() {
    env_logger::Builder::from_env(
        env_logger::Env::default()
            .default_filter_or("info,wgpu_core=error,wgpu_hal=error,naga=error"),
    )
    .init();
    let name = std::env::args().nth(1).unwrap_or("harbour".into());
    let lab = regatta::lab::Lab::new(regatta::lab::Scene::built_in(&name).unwrap());
    regatta::window::run(lab, None).unwrap();
}
