// One light in the list of lights.
#pragma once

#include "scene/scene.h"

#include <QLineEdit>
#include <QToolButton>
#include <QWidget>

namespace lampblack
{

/// Its colour and name select it; a double click on them renames it. Two buttons: on or off, and solo.
class LightRow : public QWidget
{
    Q_OBJECT

public:
    /// The objectNames begin with "lampblack.panel.light.<number>"; `number` counts from 1.
    explicit LightRow(int number, QWidget* parent = nullptr);

    /// Show a light; emits nothing.
    void setLight(const AreaLight& light, bool selected);

Q_SIGNALS:
    void selected();
    void renamed(const QString& name);
    void switched(bool on);
    void soloed(bool solo);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void beginRename();
    void endRename(bool keep);

    int mNumber;
    QToolButton* mName;
    QToolButton* mSolo;
    QToolButton* mEye;
    QLineEdit* mEdit;
    QColor mDisc; ///< colour of the icon of mName
};

/// What people call a light: its name, or "Light 2" or "Sun 2".
QString titleOf(const AreaLight& light, int number);

/// A button for a row of small tools.
QToolButton* smallButton(const QString& name, const QString& text, const QString& hint, QWidget* parent);

} // namespace lampblack
