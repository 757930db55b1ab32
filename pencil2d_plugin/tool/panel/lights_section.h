// The lights of the scene, and the numbers of the selected one.
#pragma once

#include "scene/scene_document.h"
#include "tool/panel/colour_button.h"
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
    LightsSection(SceneDocument& document, QWidget* parent = nullptr);

private:
    void refresh();
    void addLight();
    void deleteLight();
    /// Change the selected light.
    void change(const QString& text, int gesture, const std::function<void(AreaLight&)>& how);

    SceneDocument& mDocument;
    QButtonGroup* mChoice;
    std::array<QToolButton*, MaxLights> mLights{};
    QToolButton* mAdd;
    QToolButton* mDelete;
    QWidget* mNumbers;
    ColourButton* mColour;
    ValueRow* mPower;
    ValueRow* mSize;
    ValueRow* mHeight;
};

/// A button for a row of small tools.
QToolButton* smallButton(const QString& name, const QString& text, const QString& hint, QWidget* parent);

} // namespace lampblack
