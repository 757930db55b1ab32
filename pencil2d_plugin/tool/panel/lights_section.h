// The lights of the scene, and the values of the selected one.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/panel/colour_button.h"
#include "tool/panel/keys_row.h"
#include "tool/panel/section.h"
#include "tool/panel/value_row.h"

#include <QButtonGroup>

#include <array>

namespace lampblack
{

class LightsSection : public Section
{
    Q_OBJECT

public:
    LightsSection(Host& host, SceneDocument& document, QWidget* parent = nullptr);

private:
    void refresh();
    void addLight();
    void deleteLight();
    void toggleKey();
    /// Change the selected light as it is at the current frame.
    void changeLight(const QString& text, int gesture, const std::function<void(AreaLight&)>& apply);

    Host& mHost;
    SceneDocument& mDocument;
    QButtonGroup* mChoice;
    std::array<QToolButton*, MaxLights> mLights{};
    std::array<QColor, MaxLights> mDiscs; ///< colours of the icons of mLights
    QToolButton* mAdd;
    QToolButton* mDelete;
    QWidget* mNumbers;
    ColourButton* mColour;
    ValueRow* mPower;
    ValueRow* mSize;
    ValueRow* mHeight;
    KeysRow* mKeys;
};

/// A button for a row of small tools.
QToolButton* smallButton(const QString& name, const QString& text, const QString& hint, QWidget* parent);

} // namespace lampblack
