// An imitation of a Pencil2D window: the classes that the host looks for, by name.
#pragma once

#include <QButtonGroup>
#include <QDockWidget>
#include <QHBoxLayout>
#include <QMainWindow>
#include <QMenu>
#include <QPainter>
#include <QToolButton>

#include <memory>

/// Paints a red drawing, a tool's handle, and over them a guide, as Pencil2D 0.7 does.
class ScribbleArea : public QWidget
{
    Q_OBJECT
protected:
    void paintEvent(QPaintEvent*) override
    {
        QPixmap drawing(size());
        drawing.fill(Qt::red);
        QPainter painter(this);
        painter.drawPixmap(0, 0, drawing);
        painter.drawRect(2, 2, 6, 6);
        painter.setWorldTransform(QTransform::fromTranslate(10, 0));
        painter.setCompositionMode(QPainter::RasterOp_NotSourceAndNotDestination);
        painter.setPen(Qt::black);
        painter.drawLine(0, 20, 10, 20);
    }
};

class Editor : public QObject
{
    Q_OBJECT
Q_SIGNALS:
    void scrubbed(int);
    void objectLoaded();
};

class PlaybackManager : public QObject
{
    Q_OBJECT
Q_SIGNALS:
    void playStateChanged(bool);
};

class LayerManager : public QObject
{
    Q_OBJECT
Q_SIGNALS:
    void currentLayerChanged(int);
};

class ViewManager : public QObject
{
    Q_OBJECT
Q_SIGNALS:
    void viewChanged();
};

class ToolOptionWidget : public QDockWidget
{
    Q_OBJECT
};

class TimeLineCells : public QWidget
{
    Q_OBJECT
public Q_SLOTS:
    void vScrollChange(int) {}
};

class TimeControls : public QWidget
{
    Q_OBJECT
};

class ColorPaletteWidget : public QDockWidget
{
    Q_OBJECT
};

class ColorManager : public QObject
{
    Q_OBJECT
Q_SIGNALS:
    void colorChanged(QColor, int);
};

enum ToolType : int
{
};

class ToolManager : public QObject
{
    Q_OBJECT
Q_SIGNALS:
    void toolChanged(ToolType);
};

/// As in Pencil2D 0.7.2: what the dock of the tools holds, with the buttons in a group.
class ToolBoxWidget : public QWidget
{
    Q_OBJECT
public:
    ToolBoxWidget()
    {
        auto* layout = new QHBoxLayout(this);
        auto* group = new QButtonGroup(this);
        for (QToolButton* button : {&pencil, &brush})
        {
            button->setCheckable(true);
            layout->addWidget(button);
            group->addButton(button);
        }
        pencil.setChecked(true);
    }
    QToolButton pencil{this};
    QToolButton brush{this};
};

class RecentFileMenu : public QMenu
{
    Q_OBJECT
};

class MainWindow2 : public QMainWindow
{
    Q_OBJECT
};

/// A window with nothing in it but what every Pencil2D has.
inline std::unique_ptr<MainWindow2> bareWindow()
{
    auto window = std::make_unique<MainWindow2>();
    window->setCentralWidget(new ScribbleArea);
    (new Editor)->setParent(window.get());
    window->show();
    return window;
}
