// The lights of the scene, and the values of the selected one.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/panel/light_row.h"
#include "tool/panel/section.h"

#include <array>
#include <functional>

namespace lampblack
{

class LightsSection : public Section
{
    Q_OBJECT

public:
    LightsSection(Host& host, SceneDocument& document, QWidget* parent = nullptr);

Q_SIGNALS:
    void problem(const lampblack::UserError& error);

private:
    void addRow(int light);
    void addButtons();
    void refresh();
    void addLight();
    void duplicateLight();
    /// Change a light in what has no keys.
    void changeLight(int light, const QString& text, const std::function<void(AreaLight&)>& apply);

    Host& mHost;
    SceneDocument& mDocument;
    std::array<LightRow*, MaxLights> mRows{};
    QToolButton* mAdd;
    QToolButton* mDuplicate;
    QToolButton* mDelete;
    QToolButton* mRigs;
};

/// `scene` with a copy of one of its lights behind it, a little aside.
Scene withCopy(Scene scene, int light);

} // namespace lampblack
